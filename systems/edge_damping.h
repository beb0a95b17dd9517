// Damping of the stretching motion of edges.
#pragma once

#include "components/garment.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// Adds to both ends of every edge a force against the rate at which its length changes:
///   F_i = c ((v_j - v_i) . u) u,   F_j = -F_i,   c = rate / (w_i + w_j)
/// Linear and angular momentum are kept. The rate is held below 0.2 / dt, so that no step can turn the motion around.
/// Reads:  garment edges; position (P) m; velocity (P) m/s; inverse_mass (P) 1/kg
/// Writes: force (P) N, added to; packed, scratch
/// Cost:   O(E), no allocation. Errors: none; an edge shorter than 1e-9 m is passed over.
struct EdgeDamping {
  const Garment* garment = nullptr;
  ConstVec3View position, velocity;
  const float* inverse_mass = nullptr;
  float rate = 0.0f;  // 1/s
  float dt = 0.0f;    // s
  Vec4Columns* packed = nullptr;
  Vec3View force;

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
