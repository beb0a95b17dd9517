// Vectors of a column with their components beside each other, for what reads and writes them in no order: one load or
// store each.
#pragma once

#include <cstddef>
#include <cstdint>

#include "components/column.h"

namespace pleat {

struct alignas(16) Vec4 {
  float x, y, z, w;
};

constexpr Vec3 vector_of(const Vec4& a) { return {a.x, a.y, a.z}; }

/// Where in a column of them one is: in bytes, for processors scale an index by eight at most, and a shift for each
/// takes a sixth of a pass over edges.
struct Vec4Place {
  std::uint32_t bytes = 0;

  static constexpr Vec4Place of(std::uint32_t i) { return {static_cast<std::uint32_t>(i * sizeof(Vec4))}; }
  constexpr std::uint32_t index() const { return static_cast<std::uint32_t>(bytes / sizeof(Vec4)); }
};

/// column[i]
inline Vec4& at(Vec4* column, std::uint32_t i) { return column[i]; }
inline Vec4& at(Vec4* column, Vec4Place place) {
  return *reinterpret_cast<Vec4*>(reinterpret_cast<std::byte*>(column) + place.bytes);
}
inline const Vec4& at(const Vec4* column, std::uint32_t i) { return column[i]; }
inline const Vec4& at(const Vec4* column, Vec4Place place) {
  return *reinterpret_cast<const Vec4*>(reinterpret_cast<const std::byte*>(column) + place.bytes);
}

/// Where a particle is and where it goes: a single load of eight lanes.
struct alignas(32) Motion {
  Vec4 position, velocity;
};

/// Of as many particles as one cloth has, padded, and two places more for empty slots of edges (edge_slots.h): scratch
/// of what works on edges and hinges, and where the particles are while sweeps and friction move them.
struct Vec4Columns {
  Column<Vec4> position, force;  // m and, w, 1/kg of inverse mass; N
  Column<Vec4> previous;         // m, where the substep began
  Column<Vec4> begin;            // m, where a sweep began
  Column<Motion> motion;         // the same positions; m/s

  explicit Vec4Columns(std::pmr::memory_resource* m) : position(m), force(m), previous(m), begin(m), motion(m) {}
  void make_room(std::size_t particles) {
    const std::size_t wanted = padded(particles) + 2;
    if (holds(particles)) return;
    position.resize(wanted), force.resize(wanted), previous.resize(wanted), begin.resize(wanted), motion.resize(wanted);
  }
  bool holds(std::size_t particles) const { return motion.size() >= padded(particles) + 2; }
};

}  // namespace pleat
