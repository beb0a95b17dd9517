// Scratch of hinge bending: what the pass over the angles leaves to the pass over the forces.
#pragma once

#include "components/column.h"
#include "components/lanes.h"

namespace pleat {

/// Some hinges side by side, between the two passes over all of them.
struct HingeBlock {
  Vec3Lanes gradient[4];    // of the angle for each of its particles, 1/m; 0: the hinge is passed over
  Lanes damping, softness;  // N m; s_h
};

/// For as many hinges as one cloth has.
struct HingeScratch {
  Column<HingeBlock> blocks;
  Column<float> turn;  // s_h (theta - theta0), rad

  explicit HingeScratch(std::pmr::memory_resource* m) : blocks(m), turn(m) {}
  void make_room(std::uint32_t hinges) {
    const std::size_t count = (std::size_t{hinges} + kLanes - 1) / kLanes;
    at_least(blocks, count);
    at_least(turn, count * kLanes);
  }
};

}  // namespace pleat
