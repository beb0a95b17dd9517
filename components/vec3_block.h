// A few vectors side by side: what a kernel gathers from scattered places so that the compiler can run plain loops over
// the lanes with vector instructions. Each lane does the scalar arithmetic, so the bits do not depend on the width.
#pragma once

#include <cstddef>

#include "components/lanes.h"

namespace pleat {

struct Vec3Block {
  float x[kLanes], y[kLanes], z[kLanes];

  Vec3 operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(std::size_t lane, const Vec3& v) { x[lane] = v.x, y[lane] = v.y, z[lane] = v.z; }
};

}  // namespace pleat
