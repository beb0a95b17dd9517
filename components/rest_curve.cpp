#include "components/rest_curve.h"

#include <vector>

#include "components/base_normal.h"
#include "components/pn_edge.h"

namespace pleat {

void measure_rest_curves(Garment& garment) {
  const Garment& g = garment;
  const ConstVec3View position = g.rest_position.view();
  std::vector<Vec3> normal(g.particle_count);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const std::uint32_t i = g.face_particle[0][f], j = g.face_particle[1][f], k = g.face_particle[2][f];
    const Vec3 face = cross(position[j] - position[i], position[k] - position[i]);
    const auto side = [&](std::size_t s) { return g.edge_rest_length[g.face_edge[s][f]]; };
    const std::array<float, 3> weight = corner_weights({side(0), side(1), side(2)}, g.mean_edge_length);
    normal[i] += face * weight[0], normal[j] += face * weight[1], normal[k] += face * weight[2];
  }
  for (Vec3& n : normal) n = normalized_or(n, kAnyNormal);

  garment.edge_rest_curve_length.resize(g.edge_count);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    const PnEdge curve(position[i], position[j], normal[i], normal[j]);
    garment.edge_rest_curve_length[e] = curve_length(squared_speeds(curve));
  }
}

}  // namespace pleat
