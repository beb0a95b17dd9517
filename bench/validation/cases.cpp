#include "bench/validation/check.h"

namespace pleat::bench {
namespace {

constexpr Case kTable[] = {
    {"free_fall", "1 s from rest", true, free_fall},
    {"oscillator", "a triangle of springs breathes, symplectic Euler", true, oscillator},
    {"order", "slope of log error against log dt", true, order},
    {"pendulum", "1 m, ten periods, five amplitudes", false, pendulum},
    {"energy", "the oscillator for 1e5 steps", true, energy},
    {"momentum", "a shaken sheet in free flight, 1e4 steps", true, momentum},
    {"chain_swing", "small sideways oscillations of a hanging chain of 1 m", false, chain_swing},
    {"catenary", "a chain of 1 m between two points", false, catenary},
    {"own_weight", "a chain and a tube stretched by their own weight", false, own_weight},
    {"cantilever", "strips and sheets bend under their weight: height over width of the tip", false, cantilever},
    {"fabrics", "a strip of each fabric at two resolutions", false, fabrics},
    {"terminal_velocity", "a sheet falls flat through air", true, terminal_velocity},
    {"incline", "a sheet on a slope sticks or slides", false, incline},
};

}  // namespace

const std::span<const Case> kCases = kTable;

}  // namespace pleat::bench
