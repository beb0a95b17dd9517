#include "systems/crossings.h"

#include <algorithm>

#include "systems/point_grid.h"

namespace pleat {
namespace {

using Vec3d = Vec3T<double>;

Vec3d wide(const Vec3& a) { return {double{a.x}, double{a.y}, double{a.z}}; }

bool passes_through(const Vec3& from, const Vec3& to, const Vec3 (&face)[3]) {
  const Vec3d p = wide(from), q = wide(to), a = wide(face[0]), b = wide(face[1]), c = wide(face[2]);
  const Vec3d normal = cross(b - a, c - a);
  const double above = dot(normal, p - a), below = dot(normal, q - a);
  if (!(above * below < 0.0)) return false;
  const Vec3d at = p + (q - p) * (above / (above - below));
  return dot(cross(b - a, at - a), normal) > 0.0 && dot(cross(c - b, at - b), normal) > 0.0 &&
         dot(cross(a - c, at - c), normal) > 0.0;
}

}  // namespace

bool Crossings::validate() const {
  return edges.garment != nullptr && edges.position.x != nullptr && faces.garment != nullptr &&
         faces.position.x != nullptr && scratch != nullptr && scratch->middle.size() >= edges.garment->edge_count &&
         scratch->grid.holds(edges.garment->edge_count);
}

std::size_t Crossings::run() const {
  const auto& end = edges.garment->edge_particle;
  const float longest = file_middles(edges, *scratch);  // half of it, m
  const PointGrid grid(scratch->middle.view(), edges.garment->edge_count, 2.0f * longest, scratch->grid);
  std::size_t count = 0;
  for (std::uint32_t f = 0; f < faces.garment->face_count; ++f) {
    std::uint32_t corner[3];
    Vec3 x[3];
    Box box;
    for (int k = 0; k < 3; ++k) {
      corner[k] = faces.garment->face_particle[k][f];
      x[k] = faces.position[corner[k]] + apart;
      box.include(x[k]);
    }
    grid.for_each_near(box.grown(longest), [&](std::uint32_t e) {
      const std::uint32_t i = end[0][e], j = end[1][e];
      const auto is_end = [&](std::uint32_t particle) { return particle == i || particle == j; };
      if (itself && std::any_of(corner, corner + 3, is_end)) return;
      count += passes_through(edges.position[i], edges.position[j], x);
    });
  }
  return count;
}

}  // namespace pleat
