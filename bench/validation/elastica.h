#pragma once

#include <cstdint>

namespace pleat::bench {

/// A level cantilever that does not stretch, bent by its own weight: height over width of its tip below the clamp.
/// gamma = sigma g L^3 / B. As a chain of `cells` stiff links of length a and half a link that is held, L = (cells +
/// 1/2) a, with a hinge of stiffness B / a per width at each node: many cells are the continuum.
double elastica_droop(double gamma, uint32_t cells);

}  // namespace pleat::bench
