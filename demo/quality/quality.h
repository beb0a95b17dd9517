#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "demo/quality/crossings.h"
#include "demo/quality/distance.h"
#include "demo/quality/solid_mesh.h"

namespace pleat::demo {

/// How good a simulated cloth is. Strain is length / rest length - 1 of the coarse edges; penetration is the greatest
/// depth inside any body. What was not measured is absent.
struct Quality {
  double strain_max_percent = 0.0;   ///< largest elongation of any edge in any frame
  double strain_p99_percent = 0.0;   ///< 99th percentile over frames of the frame's largest elongation
  double strain_rms_percent = 0.0;   ///< elongation and compression, over all edges and frames
  double stretch_rms_percent = 0.0;  ///< over the elongated edges of all frames
  std::optional<double> penetration_particle_mm;
  std::optional<double> penetration_interior_mm;  ///< 45 samples of each coarse triangle
  std::optional<double> penetration_pinned_mm;    ///< of it between two pins, where no contact can move the cloth
  std::optional<double> penetration_drawn_mm;     ///< exact over the drawn triangles; for meshes at their corners
  std::optional<double> crossings_per_frame;      ///< coarse edges through triangles of their own cloth, mean
  std::optional<double> crossing_depth_mm;        ///< the deepest of them in any frame
  std::optional<double> crossings_drawn_per_frame, crossing_drawn_depth_mm;  ///< the same of the drawn triangles
  std::optional<double> rest_jitter_mm;   ///< RMS motion per frame of the free particles at rest
  std::optional<double> rest_speed_cm_s;  ///< of the fastest of them in any frame
};

/// What of a cloth never changes.
struct ClothMesh {
  std::vector<uint32_t> edges;      ///< (E,2) particles
  std::vector<float> rest_lengths;  ///< (E) m
  std::vector<uint32_t> triangles;  ///< (T,3) particles
  std::vector<bool> pinned;         ///< (P)
};

/// Where a cloth is after a frame. Metres, world space.
struct ClothFrame {
  std::span<const float> particles;           ///< (P,3)
  std::span<const float> drawn_vertices;      ///< (V,3), or empty: only particles are drawn
  std::span<const uint32_t> drawn_triangles;  ///< (F,3)
};

struct Bodies {
  std::vector<ExactCapsule> capsules;
  std::vector<std::shared_ptr<const SolidMesh>> meshes;
};

/// Gathers the quality of a run: begin_frame, then add_cloth for each cloth, frame by frame.
class QualityMeter {
 public:
  void begin_frame();
  void add_cloth(const ClothMesh& mesh, const ClothFrame& frame, const Bodies& bodies);
  /// How a cloth of this frame passes through itself.
  void add_crossings(const Crossings& coarse, const Crossings& drawn);
  /// Two successive frames, `dt` s apart, of a cloth whose pins and bodies rest; (P,3) m each.
  void add_rest_motion(const ClothMesh& mesh, std::span<const float> before, std::span<const float> after, double dt);

  Quality result() const;

 private:
  void add_strain(const ClothMesh& mesh, std::span<const float> particles);
  void add_penetration(const ClothMesh& mesh, const ClothFrame& frame, const Bodies& bodies);

  std::vector<double> frame_elongation_;  // the largest of each frame
  double squared_strain_ = 0.0, squared_stretch_ = 0.0, squared_motion_ = 0.0, rest_speed_ = 0.0;
  size_t strains_ = 0, stretches_ = 0, motions_ = 0;
  std::optional<double> particle_depth_, interior_depth_, pinned_depth_, drawn_depth_;  // m
  std::optional<Crossings> crossings_, drawn_crossings_;                                // of all frames
};

}  // namespace pleat::demo
