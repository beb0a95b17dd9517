#include "demo/quality/quality.h"

#include <algorithm>
#include <cmath>

namespace pleat::demo {
namespace {

constexpr int kSampleSteps = 8;  // (8 + 1)(8 + 2) / 2 = 45 samples in a triangle, corners and edges among them

Vector3d point(std::span<const float> positions, uint32_t index) {
  return {positions[3 * index], positions[3 * index + 1], positions[3 * index + 2]};
}

Triangle triangle_of(std::span<const float> positions, std::span<const uint32_t> triangles, size_t t) {
  return {point(positions, triangles[3 * t]), point(positions, triangles[3 * t + 1]),
          point(positions, triangles[3 * t + 2])};
}

double depth_of_point(const Vector3d& p, const Bodies& bodies) {
  double depth = 0.0;
  for (const ExactCapsule& capsule : bodies.capsules) depth = std::max(depth, -signed_distance(p, capsule));
  for (const auto& mesh : bodies.meshes) depth = std::max(depth, -mesh->signed_distance(p));
  return depth;
}

/// The bodies that may reach into the ball: everything else need not be asked.
Bodies near_ball(const Bodies& bodies, const Vector3d& center, double radius) {
  Bodies near;
  for (const ExactCapsule& capsule : bodies.capsules) {
    if (signed_distance(center, capsule) < radius) near.capsules.push_back(capsule);
  }
  for (const auto& mesh : bodies.meshes) {
    if (mesh->signed_distance(center) < radius) near.meshes.push_back(mesh);
  }
  return near;
}

Bodies near_triangle(const Bodies& bodies, const Triangle& t) {
  const Vector3d center = (t.a + t.b + t.c) / 3.0;
  const double radius = std::max({(t.a - center).norm(), (t.b - center).norm(), (t.c - center).norm()});
  return near_ball(bodies, center, radius);
}

Bodies near_cloth(const Bodies& bodies, std::span<const float> positions) {
  Vector3d low = point(positions, 0), high = low;
  for (uint32_t i = 1; 3 * i < positions.size(); ++i) {
    low = low.cwiseMin(point(positions, i));
    high = high.cwiseMax(point(positions, i));
  }
  return near_ball(bodies, 0.5 * (low + high), 0.5 * (high - low).norm());
}

double depth_of_samples(const Triangle& t, const Bodies& bodies) {
  double depth = 0.0;
  for (int i = 0; i <= kSampleSteps; ++i) {
    for (int j = 0; i + j <= kSampleSteps; ++j) {
      const int k = kSampleSteps - i - j;
      depth = std::max(depth, depth_of_point((i * t.a + j * t.b + k * t.c) / kSampleSteps, bodies));
    }
  }
  return depth;
}

void keep_largest(std::optional<double>& largest, double value) { largest = std::max(largest.value_or(0.0), value); }

double rms(double sum_of_squares, size_t count) { return count ? std::sqrt(sum_of_squares / double(count)) : 0.0; }

std::optional<double> millimetres(std::optional<double> metres) {
  return metres ? std::optional(1000.0 * *metres) : std::nullopt;
}

}  // namespace

void QualityMeter::begin_frame() { frame_elongation_.push_back(0.0); }

void QualityMeter::add_cloth(const ClothMesh& mesh, const ClothFrame& frame, const Bodies& bodies) {
  add_strain(mesh, frame.particles);
  add_penetration(mesh, frame, bodies);
}

void QualityMeter::add_strain(const ClothMesh& mesh, std::span<const float> particles) {
  for (size_t e = 0; e < mesh.rest_lengths.size(); ++e) {
    const double length = (point(particles, mesh.edges[2 * e + 1]) - point(particles, mesh.edges[2 * e])).norm();
    const double strain = length / double(mesh.rest_lengths[e]) - 1.0;
    squared_strain_ += strain * strain;
    ++strains_;
    if (strain <= 0.0) continue;
    squared_stretch_ += strain * strain;
    ++stretches_;
    frame_elongation_.back() = std::max(frame_elongation_.back(), strain);
  }
}

void QualityMeter::add_penetration(const ClothMesh& mesh, const ClothFrame& frame, const Bodies& all) {
  if (all.capsules.empty() && all.meshes.empty()) return;
  double particle = 0.0, interior = 0.0, pinned = 0.0, drawn = 0.0;
  const Bodies coarse = near_cloth(all, frame.particles);
  for (uint32_t i = 0; 3 * i < frame.particles.size(); ++i) {
    particle = std::max(particle, depth_of_point(point(frame.particles, i), coarse));
  }
  for (size_t t = 0; 3 * t < mesh.triangles.size(); ++t) {
    const Triangle triangle = triangle_of(frame.particles, mesh.triangles, t);
    interior = std::max(interior, depth_of_samples(triangle, near_triangle(coarse, triangle)));
  }
  for (size_t e = 0; 2 * e < mesh.edges.size(); ++e) {
    const uint32_t i = mesh.edges[2 * e], j = mesh.edges[2 * e + 1];
    if (!mesh.pinned[i] || !mesh.pinned[j]) continue;
    const Vector3d a = point(frame.particles, i), b = point(frame.particles, j);
    pinned = std::max(pinned, depth_of_samples({a, b, b}, near_triangle(coarse, {a, b, b})));
  }
  keep_largest(particle_depth_, particle);
  keep_largest(interior_depth_, interior);
  keep_largest(pinned_depth_, pinned);
  if (frame.drawn_vertices.empty()) return;
  const Bodies curved = near_cloth(all, frame.drawn_vertices);
  for (size_t t = 0; !curved.capsules.empty() && 3 * t < frame.drawn_triangles.size(); ++t) {
    const Triangle triangle = triangle_of(frame.drawn_vertices, frame.drawn_triangles, t);
    for (const ExactCapsule& capsule : curved.capsules) drawn = std::max(drawn, -signed_distance(triangle, capsule));
  }
  for (uint32_t v = 0; !curved.meshes.empty() && 3 * v < frame.drawn_vertices.size(); ++v) {
    for (const auto& body : curved.meshes) {
      drawn = std::max(drawn, -body->signed_distance(point(frame.drawn_vertices, v)));
    }
  }
  keep_largest(drawn_depth_, drawn);
}

void QualityMeter::add_crossings(const Crossings& coarse, const Crossings& drawn) {
  const auto add = [](std::optional<Crossings>& all, const Crossings& of_frame) {
    if (!all) all.emplace();
    all->count += of_frame.count;
    all->deepest = std::max(all->deepest, of_frame.deepest);
  };
  add(crossings_, coarse);
  add(drawn_crossings_, drawn);
}

void QualityMeter::add_rest_motion(const ClothMesh& mesh, std::span<const float> before, std::span<const float> after,
                                   double dt) {
  for (uint32_t i = 0; i < mesh.pinned.size(); ++i) {
    if (mesh.pinned[i]) continue;
    const double motion2 = (point(after, i) - point(before, i)).squaredNorm();
    squared_motion_ += motion2;
    rest_speed_ = std::max(rest_speed_, std::sqrt(motion2) / dt);
    ++motions_;
  }
}

Quality QualityMeter::result() const {
  Quality quality;
  if (!frame_elongation_.empty()) {
    std::vector<double> sorted = frame_elongation_;
    std::ranges::sort(sorted);
    quality.strain_max_percent = 100.0 * sorted.back();
    quality.strain_p99_percent = 100.0 * sorted[size_t(std::ceil(0.99 * double(sorted.size()))) - 1];
  }
  quality.strain_rms_percent = 100.0 * rms(squared_strain_, strains_);
  quality.stretch_rms_percent = 100.0 * rms(squared_stretch_, stretches_);
  quality.penetration_particle_mm = millimetres(particle_depth_);
  quality.penetration_interior_mm = millimetres(interior_depth_);
  quality.penetration_pinned_mm = millimetres(pinned_depth_);
  quality.penetration_drawn_mm = millimetres(drawn_depth_);
  if (crossings_) {
    const double frames = double(frame_elongation_.size());
    quality.crossings_per_frame = double(crossings_->count) / frames;
    quality.crossings_drawn_per_frame = double(drawn_crossings_->count) / frames;
    quality.crossing_depth_mm = millimetres(crossings_->deepest);
    quality.crossing_drawn_depth_mm = millimetres(drawn_crossings_->deepest);
  }
  if (motions_ > 0) {
    quality.rest_jitter_mm = 1000.0 * rms(squared_motion_, motions_);
    quality.rest_speed_cm_s = 100.0 * rest_speed_;
  }
  return quality;
}

}  // namespace pleat::demo
