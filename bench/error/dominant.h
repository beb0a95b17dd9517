#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/error/contestant.h"
#include "bench/error/reference.h"

namespace pleat::bench {

/// The error of pleat with one part in place of which its converged counterpart stands.
struct Swap {
  std::string part;
  double rms;  ///< m
};

/// Which part of pleat's error would go if a part were perfect, one at a time.
struct Blame {
  Grid grid;
  double rms;  ///< m, as it is
  /// surface    what is drawn is the truth itself, moved by the errors of the particles
  /// dynamics   the particles lie on the truth
  /// springs    the truth's springs both ways, in place of soft ones and the strain limit
  /// time step  64 substeps a frame
  /// threads    without inner friction
  /// contact    particles that lie on the body in the truth are held there; only where there is a body
  std::vector<Swap> swaps;
};

Blame blame_parts(const pleat_api& api, const RestScene& scene, const pleat_cloth_settings& settings,
                  const Reference& reference, Grid grid);

void print_blame(const RestScene& scene, const std::vector<Blame>& of_grids);
nlohmann::ordered_json blame_json(const std::vector<Blame>& of_grids);

}  // namespace pleat::bench
