// Vectors of a column with their components beside each other, for what reads and writes them in no order: one load or
// store each.
#pragma once

#include "components/column.h"

namespace pleat {

struct alignas(16) Vec4 {
  float x, y, z, w;
};

constexpr Vec3 vector_of(const Vec4& a) { return {a.x, a.y, a.z}; }

/// Where a particle is and where it goes: a single load of eight lanes.
struct alignas(32) Motion {
  Vec4 position, velocity;
};

/// Of as many particles as one cloth has, padded, and two places more for empty slots of edges (edge_slots.h): scratch
/// of what works on edges and hinges, and where the particles are while sweeps and friction move them.
struct Vec4Columns {
  Column<Vec4> position, force;  // m and, w, 1/kg of inverse mass; N
  Column<Vec4> begin;            // m, where a sweep began
  Column<Motion> motion;         // the same positions; m/s

  explicit Vec4Columns(std::pmr::memory_resource* m) : position(m), force(m), begin(m), motion(m) {}
  void make_room(std::size_t particles) {
    const std::size_t wanted = padded(particles) + 2;
    if (holds(particles)) return;
    position.resize(wanted), force.resize(wanted), begin.resize(wanted), motion.resize(wanted);
  }
  bool holds(std::size_t particles) const { return motion.size() >= padded(particles) + 2; }
};

}  // namespace pleat
