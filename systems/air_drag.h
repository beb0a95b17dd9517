// Pressure of moving air on faces: what makes cloth sail, lift, flutter and fall slowly.
//   D. Baraff, A. Witkin, "Large Steps in Cloth Simulation", 1998, section 4.5: air drag acts on the normal velocity.
//   S. Hoerner, "Fluid-Dynamic Drag", 1965: the normal force of a plate at a slant grows with the sine of the angle.
#pragma once

#include "components/garment.h"

namespace pleat {

/// Adds, for every face, a third of the air's pressure on it to each corner:
///   F = -1/2 rho A (C_d |v_n| + C_l (|v| - |v_n|)) v_n n,   v = mean velocity of the corners - wind,   v_n = v . n
/// Face on this is the drag of C_d. At a small angle it is C_l |v| v_n, like a wing's: mostly across the wind, a lift.
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
  float lift_coefficient = 0.0f;  // C_l
  float density = 0.0f;           // sigma of the cloth, kg/m2
  float dt = 0.0f;                // s
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
