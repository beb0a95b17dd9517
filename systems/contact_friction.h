// Friction between cloth and bodies, and what a contact does to velocities.
#pragma once

#include <limits>

#include "components/contacts.h"

namespace pleat {

/// Coulomb friction on positions, against the moving surface: of the distance r that the touching point has slid along
/// the body since the substep began, up to friction * push is taken back, push being how far the row has pushed.
///   x_i -= min(1, mu push / |r|) w_i b_i / (sum of w b^2) r
/// Run again, it takes back what is left of friction * push, and only where r is `longest` or less.
/// Reads:  contacts; previous (P) m, packed, when the substep began
/// Writes: position (P) m, packed; rubbed of each row
/// Cost:   O(rows), no allocation. Errors: none.
/// Runs after the sweeps and before a last CollisionResponse, since it may move a point against another row.
struct ContactFriction {
  ContactList contacts;
  const Vec4* previous = nullptr;
  float longest = std::numeric_limits<float>::infinity();  // slip, m
  Vec4* position = nullptr;

  bool validate() const;
  void run() const;
};

/// Contacts do not bounce: where a row has pushed, the touching point's velocity away from the body is taken out.
/// Reads:  contacts.  Writes: velocity (P) m/s.  Cost: O(rows).  Errors: none.
/// Runs after the velocities have been made to agree with the positions.
struct ContactVelocity {
  ContactList contacts;
  float dt = 0.0f;  // s, of the substep
  Vec3View velocity;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
