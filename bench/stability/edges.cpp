#include "bench/stability/edges.h"

#include <cmath>

namespace pleat::bench {

Edges::Edges(const pleat_api& api, const Rig& rig) {
  pleat_garment_info info{};
  info.size = sizeof info;
  rig.need(api.garment_info(rig.world(), rig.garment(), &info), "garment");
  ends_.resize(2 * info.edges);
  rest_lengths_.resize(info.edges);
  rig.need(api.garment_read_edges(rig.world(), rig.garment(), ends_.data(), rest_lengths_.data(), info.edges), "edges");
}

double Edges::largest_strain(const Rig& rig) const {
  double largest = -1.0;
  for (size_t e = 0; e < rest_lengths_.size(); ++e) {
    const Point a = rig.position(ends_[2 * e]), b = rig.position(ends_[2 * e + 1]);
    const double strain = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / double(rest_lengths_[e]) - 1.0;
    if (!(strain <= largest)) largest = strain;  // true for NaN, and stays so
    if (std::isnan(largest)) break;
  }
  return largest;
}

}  // namespace pleat::bench
