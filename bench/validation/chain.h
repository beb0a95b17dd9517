// Chains of springs that hang: what they do by statics and by small oscillations, in double precision.
#pragma once

#include <vector>

namespace pleat::bench {

inline constexpr double kGravity = 9.81f;  ///< m/s2, as the library holds it

/// Links after eq (1), all alike, each with a node at its lower (or right) end.
struct Chain {
  double link = 0.0;              ///< rest length, m
  double stiffness = 0.0;         ///< k of eq (1), N/m
  std::vector<double> node = {};  ///< kg
};

/// Length under tension T: eq (1) gives T = k (l - L) l / L, so l = L/2 (1 + sqrt(1 + 4 T / (k L))).
double stretched(const Chain& chain, double tension);

/// Lengths of the links of a chain that hangs from its upper end.
std::vector<double> hanging_lengths(const Chain& chain);

struct Swing {
  double period;              ///< s
  std::vector<double> shape;  ///< sideways displacement of each node, the last one 1
};
/// The mode-th small sideways oscillation, 1 being the slowest, of a chain that hangs from its upper end.
Swing hanging_swing(const Chain& chain, int mode);

/// Depth of a chain between two fixed ends `span` m apart at one height; the last node is the right end.
double sag(const Chain& chain, double span);

}  // namespace pleat::bench
