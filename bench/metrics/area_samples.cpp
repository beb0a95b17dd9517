#include "bench/metrics/area_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

namespace pleat::bench {

using demo::Vector3d;

Vector3d corner(const demo::TriangleMesh& mesh, uint32_t vertex) {
  const float* p = &mesh.positions[3 * size_t{vertex}];
  return {p[0], p[1], p[2]};
}

demo::Triangle triangle(const demo::TriangleMesh& mesh, size_t t) {
  const uint32_t* corners = &mesh.triangles[3 * t];
  return {corner(mesh, corners[0]), corner(mesh, corners[1]), corner(mesh, corners[2])};
}

Vector3d normal(const demo::Triangle& t) { return (t.b - t.a).cross(t.c - t.a).normalized(); }

std::vector<AreaSample> area_samples(const demo::TriangleMesh& mesh, size_t count, uint32_t seed) {
  std::vector<double> area_up_to;
  double area = 0.0;
  for (size_t t = 0; t < mesh.triangle_count(); ++t) {
    const demo::Triangle face = triangle(mesh, t);
    area += 0.5 * (face.b - face.a).cross(face.c - face.a).norm();
    area_up_to.push_back(area);
  }
  std::vector<AreaSample> samples;
  if (area == 0.0) return samples;

  std::mt19937 generator(seed);  // its numbers are the same everywhere, those of the standard's distributions are not
  const auto uniform = [&generator] { return (double(generator()) + 0.5) * 0x1p-32; };
  samples.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const double at = area * (double(i) + uniform()) / double(count);
    const auto found = std::ranges::upper_bound(area_up_to, at);
    const size_t t = std::min(size_t(found - area_up_to.begin()), area_up_to.size() - 1);
    const demo::Triangle face = triangle(mesh, t);
    const double root = std::sqrt(uniform()), along = uniform();
    const Vector3d point = (1.0 - root) * face.a + root * ((1.0 - along) * face.b + along * face.c);
    samples.push_back({point, normal(face)});
  }
  return samples;
}

}  // namespace pleat::bench
