#include "bench/error/field.h"

#include <cmath>
#include <cstdio>

#include "bench/bare_springs.h"

namespace pleat::bench {
namespace {

const std::vector<Drawing> kSurfaces = {{"flat", PLEAT_SURFACE_FLAT, 1},
                                        {"pn", PLEAT_SURFACE_PN, PLEAT_LEVEL_FAN},
                                        {"paper", PLEAT_SURFACE_PAPER, PLEAT_LEVEL_FAN},
                                        {"pleat", PLEAT_SURFACE_PLEAT, PLEAT_LEVEL_FAN},
                                        {"phong", PLEAT_SURFACE_PHONG, PLEAT_LEVEL_FAN},
                                        {"spherigon", PLEAT_SURFACE_SPHERIGON, PLEAT_LEVEL_FAN},
                                        {"arc-pn", PLEAT_SURFACE_ARC_PN, PLEAT_LEVEL_FAN},
                                        {"pleat, folds relaxed", PLEAT_SURFACE_PLEAT, PLEAT_LEVEL_FAN, 8}};
const Drawing kFlat = kSurfaces[0], kFlatSprings = {"flat, explicit springs", PLEAT_SURFACE_FLAT, 1};

Drawing pleat_as(const std::string& method, uint32_t level = PLEAT_LEVEL_FAN) {
  return {method, PLEAT_SURFACE_PLEAT, level};
}

/// Springs of the reference both ways, no strain limit.
Dynamics implicit_springs(Grid grid, pleat_cloth_settings settings) {
  settings.integrator = PLEAT_INTEGRATOR_IMPLICIT_EULER;
  settings.stiffness = kSpring;
  settings.buckling_strain = 1.0f;
  settings.stretch_limit = 1.0f;
  return {"implicit", grid, settings, std::nullopt};
}

void add(std::vector<Contestants>& all, const Dynamics& dynamics, const std::vector<Drawing>& drawings) {
  all.push_back({dynamics, drawings});
}

std::string words(const BulletSettings& peer, uint32_t ticks) {
  char text[80];
  std::snprintf(text, sizeof text, "%d it., 1/%u s, stiffness %g, bending %g", peer.iterations, 60 * ticks,
                peer.stiffness, peer.bending);
  return text;
}

/// Of a body it samples distances closely; of bending, which is not a matter of its own there, it is given several
/// stiffnesses where the cloth's is felt.
void add_peers(std::vector<Contestants>& all, const RestScene& scene, Grid grid, const pleat_cloth_settings& settings,
               bool quick) {
  const bool stiff_cloth = scene.bend_stiffness > settings.density * 1e-3f;
  std::vector<double> bendings = {0.0};
  if (stiff_cloth) bendings.insert(bendings.end(), {0.003, 0.03, 0.3});
  for (const int iterations : quick ? std::vector{4, 16} : std::vector{1, 4, 16, 64}) {
    for (const uint32_t ticks : quick ? std::vector{1u, 4u} : std::vector{1u, 2u, 4u}) {
      for (const double stiffness : quick ? std::vector{1.0} : std::vector{1.0, 0.3}) {
        for (const double bending : bendings) {
          const BulletSettings peer{.iterations = iterations,
                                    .voxel_size = scene.body ? 0.05 : 0.25,
                                    .stiffness = stiffness,
                                    .bending = bending};
          add(all, {words(peer, ticks), grid, settings, peer, ticks}, {{"Bullet", PLEAT_SURFACE_FLAT, 1}});
        }
      }
    }
  }
}

}  // namespace

Dynamics explicit_springs(const pleat_api& api, const RestScene& scene, Grid grid,
                          const pleat_cloth_settings& settings) {
  const auto substeps = uint32_t(std::ceil(kFrame / stable_substep(api, scene, grid)));
  const uint32_t ticks = (substeps + kMostSubsteps - 1) / kMostSubsteps;
  Dynamics d{"explicit springs", grid, settings, std::nullopt, ticks};
  use_bare_springs(d.settings, kSpring, (substeps + ticks - 1) / ticks);
  return d;
}

std::vector<Contestants> contestants(const pleat_api& api, const RestScene& scene, const pleat_cloth_settings& settings,
                                     bool quick) {
  std::vector<Contestants> all;
  const size_t densities = quick ? 2 : scene.coarse.size();
  for (size_t i = 0; i < densities; ++i) {
    const Grid grid = scene.coarse[i];
    std::vector<Drawing> surfaces = kSurfaces;
    if (!quick) {
      surfaces.push_back(pleat_as("pleat, level 1", 1));
      surfaces.push_back(pleat_as("pleat, level 4", 4));
    }
    add(all, {"default", grid, settings, {}}, surfaces);
    if (!quick && i + 1 < densities) {  // at the last they take minutes
      pleat_cloth_settings more = settings;
      more.substeps = 32;
      add(all, {"32 substeps", grid, more, {}}, {pleat_as("pleat, 32 substeps")});
      pleat_cloth_settings soft = settings;  // all on the strain limit
      soft.integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
      soft.stiffness = 30.0f;
      soft.buckling_strain = 1.0f;
      add(all, {"soft springs, 30 N/m", grid, soft, {}}, {pleat_as("pleat, soft springs")});
      add(all, implicit_springs(grid, settings), {pleat_as("pleat, implicit")});
    }
    add(all, explicit_springs(api, scene, grid, settings), {pleat_as("pleat, explicit springs"), kFlatSprings});
    add_peers(all, scene, grid, settings, quick);
  }
  // The way without curved surfaces: more particles.
  if (quick) {
    add(all, {"default", scene.coarse[2], settings, {}}, {kFlat});
    add_peers(all, scene, scene.coarse[2], settings, quick);
  }
  return all;
}

}  // namespace pleat::bench
