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
    const Vec3 face = face_cross(g, f, position);
    const std::array<float, 3> weight = corner_weights(g, f);
    for (std::size_t k = 0; k < 3; ++k) normal[g.face_particle[k][f]] += face * weight[k];
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
