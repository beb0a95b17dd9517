// Which side of a body a drawn triangle has to stay on.
#pragma once

#include <cstdint>

#include "components/vec3.h"

namespace pleat {

/// All three drawn vertices have to satisfy  normal . x >= height.
struct ClearancePlane {
  Vec3 normal;   // out of the body, unit
  float height;  // m
  std::uint32_t vertex[3];
};

}  // namespace pleat
