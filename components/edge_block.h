// A few neighbouring edges side by side, with what their PN curves need, for kernels over lanes.
#pragma once

#include <algorithm>

#include "components/garment.h"
#include "components/pn_edge.h"
#include "components/vec3_block.h"

namespace pleat {

struct EdgeBlock {
  Vec3Block a, b, na, nb;  // ends, m, and their unit normals
  float target[kLanes];    // m, length of the curve at rest

  /// Edges begin .. begin + count of g, count from 1 to kLanes; further lanes repeat the last edge.
  void gather(const Garment& g, ConstVec3View position, ConstVec3View normal, std::uint32_t begin,
              std::uint32_t count) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t e = begin + std::min(lane, count - 1);
      const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
      a.set(lane, position[i]), na.set(lane, normal[g.edge_normal[0][e]]);
      b.set(lane, position[j]), nb.set(lane, normal[g.edge_normal[1][e]]);
      target[lane] = g.edge_rest_curve_length[e];
    }
  }
  PnEdge curve(std::size_t lane) const { return {a[lane], b[lane], na[lane], nb[lane]}; }
};

}  // namespace pleat
