// How far a cloth is stretched.
#pragma once

#include "components/garment.h"

namespace pleat {

/// The largest elongation of any edge that can give way, l/L - 1; 0 where none is elongated.
/// Reads:  garment edges; position (P) m; inverse_mass (P) 1/kg.  Cost: O(E), no allocation.  Errors: none.
struct LargestStretch {
  const Garment* garment = nullptr;
  ConstVec3View position;
  const float* inverse_mass = nullptr;

  bool validate() const;
  float run() const;
};

}  // namespace pleat
