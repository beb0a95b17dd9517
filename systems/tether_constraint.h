// Limit on how far particles come from pins.
//   T.-Y. Kim, N. Chentanez, M. Mueller, "Long Range Attachments: A Method to Simulate Inextensible Clothing in
//   Computer Games", 2012.
#pragma once

#include "components/garment.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// One pass over the tethers: a particle i farther from its pin p than the way over the cloth comes back along the
/// straight line.
///   C = |x_p - x_i| - (1 + limit) way > 0:   x_i += C u,   u = (x_p - x_i) / |x_p - x_i|
/// The edges ask for the same, but a pull through many of them takes many passes. The pin takes the momentum.
/// Reads:  garment tethers
/// Writes: position (P) m, packed
/// Cost:   O(T), no allocation. Errors: none.
struct TetherConstraint {
  const Garment* garment = nullptr;
  float limit = 0.0f;        // fraction of the way
  Vec4* position = nullptr;  // and a place more: edge_slots.h

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
