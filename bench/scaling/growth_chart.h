#pragma once

#include <span>
#include <string>

#include "bench/scaling/growth.h"

namespace pleat::bench {

/// Time a particle over particles, both logarithmic, a curve for each scene; the band is within 25 % of a scene's
/// middle.
std::string growth_chart(std::span<const Growth> scenes);

}  // namespace pleat::bench
