#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "demo/quality/distance.h"
#include "demo/scenes/drawn_surface.h"

namespace pleat::demo {

/// How calm a drawn surface is from frame to frame, and how true to the length and the area of the cloth at rest.
struct SurfaceMotion {
  double normal_turn_deg;     ///< of drawn normals in a frame, 99th percentile over vertices and frames
  double flat_turn_deg;       ///< the same of the coarse triangles: no surface that follows them at once turns less
  double acceleration_mm;     ///< mm/frame^2, RMS second difference of drawn vertices
  double length_rms_percent;  ///< coarse edges, along the curve drawn over them, against the same at rest
  double area_mean_percent;   ///< drawn area / rest area - 1, over frames
  double area_worst_percent;  ///< the same in the frame where it is furthest from 0
};

/// What of a drawn cloth never changes.
struct SurfaceMesh {
  std::vector<uint32_t> triangles;           ///< (T,3) particles
  std::vector<uint32_t> drawn_triangles;     ///< (F,3) drawn vertices
  std::vector<std::vector<uint32_t>> edges;  ///< (E) drawn vertices along a coarse edge, from one end to the other
  std::vector<double> rest_lengths;          ///< (E) m, along the edge as it is drawn at rest
  double rest_area;                          ///< m2, of what is drawn at rest
};

/// Length of a chain of drawn vertices, m.
double chain_length(std::span<const DrawnSurface::Vertex> drawn, std::span<const uint32_t> chain);

/// Area of drawn triangles (F,3), m2.
double surface_area(std::span<const DrawnSurface::Vertex> drawn, std::span<const uint32_t> triangles);

/// Counts angles from 0 to 180 degrees in steps of a hundredth, so that a long run needs no more room than a short one.
class AngleHistogram {
 public:
  void add(double degrees);
  /// The least angle that at least `share` of those counted do not exceed, to .01 degrees; 0 where none was counted.
  double percentile(double share) const;

 private:
  std::vector<uint64_t> counts_ = std::vector<uint64_t>(18001);
};

/// Gathers the motion of a drawn cloth over successive frames.
class SurfaceMotionMeter {
 public:
  explicit SurfaceMotionMeter(SurfaceMesh mesh) : mesh_(std::move(mesh)) {}

  /// particles: (P,3) m; drawn: (V).
  void add_frame(std::span<const float> particles, std::span<const DrawnSurface::Vertex> drawn);
  SurfaceMotion result() const;

 private:
  void add_turns(std::span<const float> particles, std::span<const DrawnSurface::Vertex> drawn);
  void add_acceleration(std::span<const DrawnSurface::Vertex> drawn);
  void add_lengths(std::span<const DrawnSurface::Vertex> drawn);
  void add_area(std::span<const DrawnSurface::Vertex> drawn);

  SurfaceMesh mesh_;
  std::array<std::vector<Vector3d>, 2> before_;   // drawn positions one frame and two frames ago
  std::vector<Vector3d> normals_, face_normals_;  // of the frame before
  AngleHistogram turns_, face_turns_;
  double squared_acceleration_ = 0.0, squared_length_error_ = 0.0, area_error_ = 0.0, worst_area_error_ = 0.0;
  size_t accelerations_ = 0, lengths_ = 0, frames_ = 0;
};

}  // namespace pleat::demo
