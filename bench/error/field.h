#pragma once

#include <vector>

#include "bench/error/contestant.h"

namespace pleat::bench {

/// The reference's springs both ways without strain limit, explicitly in as many substeps as they need.
Dynamics explicit_springs(const pleat_api& api, const RestScene& scene, Grid grid,
                          const pleat_cloth_settings& settings);

/// Who competes in a scene: all surfaces over the dynamics of `settings`, the other integrators, stiff springs in place
/// of the strain limit, the same drawn flat on finer and finer grids, and Bullet's soft body at each of the settings
/// that are searched. `quick`: a few of each.
struct Contestants {
  Dynamics dynamics;
  std::vector<Drawing> drawings;
};
std::vector<Contestants> contestants(const pleat_api& api, const RestScene& scene, const pleat_cloth_settings& settings,
                                     bool quick);

}  // namespace pleat::bench
