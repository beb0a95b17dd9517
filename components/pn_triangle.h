// Curved PN triangles: a cubic patch from three points and their normals.
//   A. Vlachos, J. Peters, C. Boyd, J. L. Mitchell, "Curved PN Triangles", 2001.
// The ten control points need not be formed. With w_ij = (P_j - P_i).N_i the patch is the flat triangle less six terms,
//   X(p) = p_0 P_0 + p_1 P_1 + p_2 P_2 - sum over the corners i and their neighbours j of  bend_weight_ij(p) w_ij N_i,
// so a flat face with upright normals is reproduced exactly.
#pragma once

#include <array>
#include <cstddef>

#include "components/vec3.h"
#include "components/wide.h"

namespace pleat {

/// Weights of the six terms at barycentrics p, in the order of PnTriangle::bend: the side from corner k to l, with m
/// across from it, has p_k p_l (p_k + p_m / 2) for its term at k and p_k p_l (p_l + p_m / 2) for that at l.
constexpr std::array<float, 6> bend_weights(const float (&p)[3]) {
  std::array<float, 6> w{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    w[2 * k] = p[k] * p[l] * (p[k] + 0.5f * p[m]);
    w[2 * k + 1] = p[k] * p[l] * (p[l] + 0.5f * p[m]);
  }
  return w;
}

/// T: float, or lanes of as many faces.
template <class T>
struct PnTriangleT {
  Vec3T<T> corner[3];
  Vec3T<T> bend[6];  // w_kl N_k and w_lk N_l of side k = 0, 1, 2

  PLEAT_KERNEL PnTriangleT(const Vec3T<T> (&p)[3], const Vec3T<T> (&n)[3]) : corner{p[0], p[1], p[2]} {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const Vec3T<T> side = p[l] - p[k];
      bend[2 * k] = n[k] * dot(side, n[k]);
      bend[2 * k + 1] = n[l] * -dot(side, n[l]);
    }
  }

  /// The point of the flat triangle at barycentrics p.
  PLEAT_KERNEL Vec3T<T> flat(const float (&p)[3]) const {
    return corner[0] * p[0] + corner[1] * p[1] + corner[2] * p[2];
  }
  /// The point at barycentrics p with their weights = bend_weights(p).
  PLEAT_KERNEL Vec3T<T> point(const float (&p)[3], const std::array<float, 6>& weights) const {
    Vec3T<T> x = flat(p);
    for (std::size_t i = 0; i < 6; ++i) x -= bend[i] * weights[i];
    return x;
  }
};
using PnTriangle = PnTriangleT<float>;

}  // namespace pleat
