// One pass over the edges of a cloth, in order: each is solved where those before it have left its ends. Edges in slots
// beside each other share no particle and are solved at once, with the bits that one after the other would give.
#pragma once

#include "components/edge_slots.h"
#include "components/lanes.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// What a pass goes through. In slots; see edge_slots.h, edge_ways.h.
struct EdgeColumns {
  const Vec4Place* place[2];
  const float* rest_length;  // m
  ConstVec3View way;         // m
  Vec4* packed;              // of particles and two places for the ends of empty slots: m and 1/kg
};

/// An edge.
struct OneEdge {
  struct End {
    Vec3 vector;
    float w;
  };
  const EdgeColumns& in;
  std::uint32_t slot;

  PLEAT_KERNEL float rest_length() const { return in.rest_length[slot]; }
  PLEAT_KERNEL Vec3 way() const { return in.way[slot]; }
  PLEAT_KERNEL End end(std::size_t k) const {
    const Vec4& end = at(in.packed, in.place[k][slot]);
    return {vector_of(end), end.w};
  }
  PLEAT_KERNEL void put(std::size_t k, const Vec3& vector, float w) const {
    at(in.packed, in.place[k][slot]) = {vector.x, vector.y, vector.z, w};
  }
};

/// Edges side by side.
struct EightEdges {
  const EdgeColumns& in;
  std::uint32_t slot;

  PLEAT_KERNEL Lanes rest_length() const { return load(in.rest_length + slot); }
  PLEAT_KERNEL Vec3Lanes way() const { return load(in.way, slot); }
  PLEAT_KERNEL Vec4Lanes end(std::size_t k) const { return gather(in.packed, in.place[k] + slot); }
  PLEAT_KERNEL void put(std::size_t k, const Vec3Lanes& vector, const Lanes& w) const {
    scatter(vector, w, in.place[k] + slot, in.packed);
  }
};

/// solve(OneEdge) or solve(EightEdges), in order. Without AVX2, where lanes are split, edge by edge is quicker; so it
/// is where most slots are empty, as in small cloths that hang from few pins.
template <class Solve>
PLEAT_KERNEL void for_each_edge(const EdgeSlots& slots, ConstVec3View way, Column<Vec4>& packed, VectorSet set,
                                const Solve& solve) {
  constexpr std::uint32_t kMostSlotsPerEdge = 2;
  const std::uint32_t empty = slots.empty_place;
  packed[empty] = {0.0f, 0.0f, 0.0f, 0.0f}, packed[empty + 1] = {1.0f, 0.0f, 0.0f, 0.0f};
  const EdgeColumns in{{slots.place[0].data(), slots.place[1].data()}, slots.rest_length.data(), way, packed.data()};
  if (set == VectorSet::kBaseline || slots.count > kMostSlotsPerEdge * slots.edge_count) {
    for (std::uint32_t s = 0; s < slots.count; ++s) {
      if (slots.particle(0, s) != empty) solve(OneEdge{in, s});
    }
  } else {
    for (std::uint32_t s = 0; s < slots.count; s += kLanes) solve(EightEdges{in, s});
  }
}

}  // namespace pleat
