#include "systems/surface_carry.h"

#include "components/wide.h"

namespace pleat {

bool SurfaceCarry::validate() const { return position.x != nullptr && normal.x != nullptr; }

void SurfaceCarry::run() const {
  run_wide(widest_vectors(), [this] {
    for (std::size_t i = 0; i < vertex_count; ++i) position.set(i, motion.apply(position[i]));
    for (std::size_t i = 0; i < shaded_count; ++i) normal.set(i, rotate(motion.rotation, normal[i]));
    if (tangent.x == nullptr) return;
    for (std::size_t i = 0; i < shaded_count; ++i) tangent.set(i, rotate(motion.rotation, tangent[i]));
  });
}

}  // namespace pleat
