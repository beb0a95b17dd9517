#include "components/rest_curve.h"

#include "components/base_normal.h"
#include "components/creases.h"
#include "components/pn_edge.h"

namespace pleat {

void measure_rest_curves(Garment& garment) {
  const Garment& g = garment;
  const ConstVec3View position = g.rest_position.view();
  Vec3Column column(std::pmr::new_delete_resource());
  column.resize(g.normal_count);
  const Vec3View normal = column.view();
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const Vec3 a = position[g.face_particle[0][f]];
    const Vec3 face = cross(position[g.face_particle[1][f]] - a, position[g.face_particle[2][f]] - a);
    const auto side = [&](std::size_t s) { return g.edge_rest_length[g.face_edge[s][f]]; };
    const std::array<float, 3> weight = corner_weights<float>({side(0), side(1), side(2)}, g.mean_edge_length);
    for (std::size_t k = 0; k < 3; ++k) normal.add(g.face_normal[k][f], face * weight[k]);
  }
  complete_normals(g, normal);
  normalize(normal, g.normal_count);

  garment.edge_rest_curve_length.resize(g.edge_count);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    const PnEdge curve(position[i], position[j], normal[g.edge_normal[0][e]], normal[g.edge_normal[1][e]]);
    garment.edge_rest_curve_length[e] = curve_length(squared_speeds(curve));
  }
}

}  // namespace pleat
