// Carries a drawn surface rigidly to another place.
#pragma once

#include <cstddef>

#include "components/column.h"
#include "components/rigid_pose.h"

namespace pleat {

/// Places go with the motion, and directions turn with it.
/// Writes: position (V drawn) m; normal (S shaded) unit; tangent (S) unit, may be null
/// Cost:   O(V + S), no allocation. Errors: none.
struct SurfaceCarry {
  RigidMotion motion;
  std::size_t vertex_count = 0, shaded_count = 0;
  Vec3View position, normal, tangent;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
