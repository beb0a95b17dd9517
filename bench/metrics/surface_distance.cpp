#include "bench/metrics/surface_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/metrics/area_samples.h"
#include "demo/quality/solid_mesh.h"

namespace pleat::bench {
namespace {

struct Sums {
  double squared_distance = 0.0, squared_angle = 0.0, greatest = 0.0;
  size_t count = 0;
};

void add_one_way(const demo::TriangleMesh& from, const demo::TriangleMesh& to, size_t samples, uint32_t seed,
                 Sums& sums) {
  const demo::SolidMesh target(to.positions, to.triangles);
  for (const AreaSample& sample : area_samples(from, samples, seed)) {
    const demo::SolidMesh::Place place = target.nearest(sample.point);
    const double distance = std::abs(place.distance);
    // Well conditioned for small angles, where the arc cosine is not.
    const double angle = std::atan2(sample.normal.cross(place.normal).norm(), sample.normal.dot(place.normal));
    sums.squared_distance += distance * distance;
    sums.squared_angle += angle * angle;
    sums.greatest = std::max(sums.greatest, distance);
    ++sums.count;
  }
}

}  // namespace

SurfaceDistance surface_distance(const demo::TriangleMesh& a, const demo::TriangleMesh& b, size_t samples,
                                 uint32_t seed) {
  Sums sums;
  add_one_way(a, b, samples, seed, sums);
  add_one_way(b, a, samples, seed + 1, sums);
  const auto count = double(sums.count);
  return {std::sqrt(sums.squared_distance / count), sums.greatest,
          std::sqrt(sums.squared_angle / count) * 180.0 / std::numbers::pi};
}

}  // namespace pleat::bench
