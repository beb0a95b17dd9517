// Vectors of a column with their components beside each other, for what reads and writes them in no order: one load or
// store each.
#pragma once

#include "components/column.h"

namespace pleat {

struct alignas(16) Vec4 {
  float x, y, z, w;
};

constexpr Vec3 vector_of(const Vec4& a) { return {a.x, a.y, a.z}; }

/// Of as many particles as one cloth has, padded, and two places more for empty slots of edges (garment.h): scratch of
/// what works on edges and hinges.
struct Vec4Columns {
  Column<Vec4> position, velocity, force;  // m and, w, 1/kg of inverse mass; m/s; N

  explicit Vec4Columns(std::pmr::memory_resource* m) : position(m), velocity(m), force(m) {}
  void make_room(std::size_t particles) {
    const std::size_t wanted = padded(particles) + 2;
    for (Column<Vec4>* c : {&position, &velocity, &force}) {
      if (c->size() < wanted) c->resize(wanted);
    }
  }
  bool holds(std::size_t particles) const { return force.size() >= padded(particles) + 2; }
};

}  // namespace pleat
