#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/error/contestant.h"
#include "bench/metrics/wrinkle_spectrum.h"

namespace pleat::bench {

/// A cloth that may buckle in several ways, or moves: where it ends up can be said only of many starts together.
struct EnsembleScene {
  RestScene cloth;    ///< `fine`: the grid of the reference
  double seconds;     ///< after which it is looked at
  float air_damping;  ///< 1/s
  bool rests;         ///< by then
};

/// Hung slack from two corners; from three points of its upper edge; falling from level between two corners.
std::span<const EnsembleScene> ensemble_scenes();
pleat_cloth_settings ensemble_settings(const pleat_api& api, const EnsembleScene& scene);

inline constexpr uint32_t kMembers = 8;  ///< starts

/// The scene's start, bent across by smooth waves of some millimetres that a seed decides, the same for every grid; not
/// at the pins. (P,3) m.
std::vector<float> perturbed_start(const RestScene& scene, Grid grid, uint32_t seed);

/// A number of each member: its mean and standard deviation.
struct Scatter {
  double mean, deviation;
};
Scatter scatter_of(std::span<const double> values);

/// What is common to shapes of kFineSide^2 points, evenly spaced in u and v, and how much they differ.
struct Ensemble {
  std::vector<float> mean;  ///< (kFineSide^2,3) m
  double spread;            ///< m, RMS distance of a point of a member from that of the mean
  std::array<Scatter, std::tuple_size_v<WrinkleSpectrum>> wrinkles;  ///< m2, band by band
  Scatter lowest;                                                    ///< m, y of the lowest point
  Scatter deep;                                                      ///< m, from the rearmost point to the foremost, z
};
Ensemble summarize(std::span<const std::vector<float>> shapes);

/// What is drawn over `grid` at each of the members' ends, flat and as `drawings` say, at the points of an Ensemble.
std::vector<Ensemble> run_members(const pleat_api& api, const EnsembleScene& scene, const Dynamics& dynamics,
                                  const std::vector<Drawing>& drawings, const std::function<void()>& step);

/// The same on the reference's mesh, with the springs of `explicit_springs`, and on one of half as many cells a side.
struct EnsembleReference {
  Ensemble fine, half;
};
EnsembleReference solve_ensemble(const pleat_api& api, const EnsembleScene& scene, const std::function<void()>& step);

/// As kept in `NAME_ensemble.json` and `NAME_mean.f32`, `NAME_mean_half.f32`. Throw as read_fine.
EnsembleReference read_ensemble(const std::filesystem::path& folder, const EnsembleScene& scene);
void write_ensemble(const std::filesystem::path& folder, const EnsembleScene& scene,
                    const EnsembleReference& reference);

/// A way to simulate and draw the scene, against the reference.
struct EnsembleScore {
  std::string method;
  Grid grid;
  Ensemble ensemble;
};
/// RMS distance between the points of two means, m, and what it would be by chance if both were of the same shapes.
struct MeanDistance {
  double rms, chance;
};
MeanDistance mean_distance(const Ensemble& a, const Ensemble& b);

struct EnsembleScores {
  const EnsembleScene* scene;
  EnsembleReference reference;
  std::vector<EnsembleScore> scores;
};
/// Our surface over the dynamics of `settings`, the same drawn flat and bare springs drawn flat, at 66, 264 and 1056
/// particles; with `quick` at the first of these. Calls `step` ensemble_steps(quick) times.
EnsembleScores score_ensemble(const pleat_api& api, const EnsembleScene& scene, const pleat_cloth_settings& settings,
                              const EnsembleReference& reference, bool quick, const std::function<void()>& step);
uint32_t ensemble_steps(bool quick);

void print_ensembles(const std::vector<EnsembleScores>& all);
nlohmann::ordered_json ensembles_json(const std::vector<EnsembleScores>& all);

}  // namespace pleat::bench
