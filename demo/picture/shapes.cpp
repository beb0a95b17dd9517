#include "demo/picture/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleat::demo {

// Rings of vertices from pole a to pole b: a cap at each end, between them the wall, square to which both caps end.
Mesh capsule_mesh(const Capsule& capsule) {
  constexpr std::uint32_t kSides = 24;
  constexpr std::uint32_t kRings = 7;  // of a half sphere, pole and equator included
  constexpr float kPi = std::numbers::pi_v<float>;
  const Eigen::Vector3f core = capsule.b - capsule.a;
  const Eigen::Vector3f axis = core.norm() > 1e-9f ? core.normalized() : Eigen::Vector3f::UnitY();
  const Eigen::Vector3f side = axis.unitOrthogonal();
  const Eigen::Vector3f front = axis.cross(side);
  const float lean = core.norm() > std::abs(capsule.taper) ? std::asin(-capsule.taper / core.norm()) : 0.0f;

  Mesh mesh;
  mesh.front = mesh.back = capsule.rgba;
  for (std::uint32_t ring = 0; ring < 2 * kRings; ++ring) {
    const bool at_a = ring < kRings;
    const float share = static_cast<float>(at_a ? ring : ring - kRings) / (kRings - 1);
    const float latitude = at_a ? lean - (kPi / 2 + lean) * (1 - share) : lean + (kPi / 2 - lean) * share;
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / kSides;
      const Eigen::Vector3f normal =
          std::sin(latitude) * axis + std::cos(latitude) * (std::cos(angle) * side + std::sin(angle) * front);
      const Eigen::Vector3f position =
          (at_a ? capsule.a : capsule.b) + (at_a ? capsule.radius : capsule.radius + capsule.taper) * normal;
      mesh.vertices.insert(mesh.vertices.end(), position.begin(), position.end());
      mesh.vertices.insert(mesh.vertices.end(), normal.begin(), normal.end());
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < 2 * kRings; ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t low = ring * kSides + i, low_next = ring * kSides + (i + 1) % kSides;
      const std::uint32_t high = low + kSides, high_next = low_next + kSides;
      mesh.indices.insert(mesh.indices.end(), {low, low_next, high_next, low, high_next, high});
    }
  }
  return mesh;
}

std::vector<Stick> wire_sticks(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back(std::minmax({mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  std::vector<Stick> sticks;
  sticks.reserve(edges.size());
  for (const auto& [from, to] : edges) {
    sticks.push_back(
        {Eigen::Vector3f(&mesh.vertices[6 * from]), Eigen::Vector3f(&mesh.vertices[6 * to]), mesh.wire, 1.2f});
  }
  return sticks;
}

}  // namespace pleat::demo
