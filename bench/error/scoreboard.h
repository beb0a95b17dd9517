#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/error/contest.h"
#include "bench/error/log_chart.h"

namespace pleat::bench {

/// A scene, what its truth is good for, and how all did in it.
struct SceneScores {
  const RestScene* scene;
  SurfaceDistance halving;   ///< of the reference from that of half the mesh
  WrinkleSpectrum wrinkles;  ///< of the reference
  std::vector<Score> scores;
};

/// How long others take to come as close to the truth as pleat does over these particles.
struct EqualError {
  Grid grid;
  double ms, rms;                                ///< of pleat; m
  std::optional<double> flat_ratio, peer_ratio;  ///< time over pleat's; absent where the best of them stays further off
};
std::vector<EqualError> equal_errors(const SceneScores& of_scene);

/// Tables of all scenes, then of the times to equal error with the bars that they meet.
void print_scores(const std::vector<SceneScores>& all);
nlohmann::ordered_json scores_json(const std::vector<SceneScores>& all);
/// A panel a scene, a curve a method; of Bullet only the settings that none of its own beats.
std::string draw_scores(const std::vector<SceneScores>& all);

}  // namespace pleat::bench
