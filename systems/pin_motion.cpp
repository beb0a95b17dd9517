#include "systems/pin_motion.h"

namespace pleat {

bool PinMotion::validate() const {
  return garment != nullptr && pin_previous.x != nullptr && pin_next.x != nullptr && position.x != nullptr &&
         velocity.x != nullptr && dt > 0.0f && t0 >= 0.0f && t1 <= 1.0f && t0 < t1;
}

void PinMotion::run() const {
  for (std::size_t k = 0; k < garment->pins.size(); ++k) {
    const std::uint32_t i = garment->pins[k];
    const Vec3 from = pin_previous[k], motion = pin_next[k] - from;
    position.set(i, from + motion * t0);
    velocity.set(i, motion * ((t1 - t0) / dt));
  }
}

}  // namespace pleat
