// Bodies that cloth touches, as flat columns: capsules (a sphere is a capsule of zero length) and triangle meshes.
// Each has a previous and a next pose; within a tick it moves from one to the other in a straight line.
#pragma once

#include <cstdint>

#include "components/column.h"

namespace pleat {

/// Capsules, one element each: all points within radius of the segment ab. World space, m.
struct CapsuleColumns {
  Vec3Column previous_a, previous_b, next_a, next_b;
  Column<float> radius, friction;
  Column<std::uint8_t> enabled;

  explicit CapsuleColumns(std::pmr::memory_resource* m)
      : previous_a(m), previous_b(m), next_a(m), next_b(m), radius(m), friction(m), enabled(m) {}
  std::size_t size() const { return radius.size(); }
};

/// One triangle mesh with outward, counter-clockwise faces.
struct MeshCollider {
  Vec3Column previous, next;        // vertices, world space, m
  Column<std::uint32_t> triangles;  // 3 vertex indices each
  float friction = 1.0f;
  bool enabled = true;

  explicit MeshCollider(std::pmr::memory_resource* m) : previous(m), next(m), triangles(m) {}
};

/// A capsule at one moment of a substep: where its core is and how far it moves until the substep ends.
struct CapsulePose {
  Vec3 a, b;              // core at the end of the substep, m
  Vec3 step_a, step_b;    // motion of its ends over the substep, m
  float radius = 0.0f;    // m
  float friction = 1.0f;  // multiplied by the cloth's
  std::uint32_t index = 0;
};

}  // namespace pleat
