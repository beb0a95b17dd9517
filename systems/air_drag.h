// Drag of moving air on faces: what makes cloth sail, flutter and fall slowly.
//   D. Baraff, A. Witkin, "Large Steps in Cloth Simulation", 1998, section 4.5: air drag acts on the normal velocity.
#pragma once

#include "components/garment.h"

namespace pleat {

/// Adds, for every face, a third of its drag to each corner:
///   F = -1/2 rho C_d A |v_n| v_n n,   v_n = (mean velocity of the corners - wind) . n
/// The coefficient is held so that no step can turn v_n around, whatever the wind: F dt <= sigma A |v_n|.
/// Reads:  garment faces; position (P) m; velocity (P) m/s
/// Writes: force (P) N, added to
/// Cost:   O(F), no allocation. Errors: none; a face without an area is passed over.
struct AirDrag {
  const Garment* garment = nullptr;
  ConstVec3View position, velocity;
  Vec3 wind;                      // m/s
  float air_density = 0.0f;       // rho, kg/m3
  float drag_coefficient = 0.0f;  // C_d
  float density = 0.0f;           // sigma of the cloth, kg/m2
  float dt = 0.0f;                // s
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
