// A few neighbouring edges side by side, with what their PN curves need, for kernels over lanes.
#pragma once

#include "components/garment.h"
#include "components/lanes.h"
#include "components/pn_edge.h"

namespace pleat {

struct EdgeBlock {
  Vec3Lanes a, b, na, nb;  // ends, m, and their unit normals

  /// Edges from `begin` on, and the padding of g's columns where they end.
  PLEAT_KERNEL EdgeBlock(const Garment& g, ConstVec3View position, ConstVec3View normal, std::uint32_t begin)
      : a(gather(position, g.edge_particle[0].data() + begin)),
        b(gather(position, g.edge_particle[1].data() + begin)),
        na(gather(normal, g.edge_normal[0].data() + begin)),
        nb(gather(normal, g.edge_normal[1].data() + begin)) {}

  PnEdgeT<Lanes> curve() const { return {a, b, na, nb}; }
};

}  // namespace pleat
