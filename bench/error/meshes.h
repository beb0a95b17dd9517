#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/error/pareto.h"
#include "bench/error/reference.h"
#include "bench/error/rest_scene.h"

namespace pleat::bench {

/// How near pleat comes to the truth of a scene over one grid.
struct MeshScore {
  Grid grid;
  double ms, rms;  ///< a frame of 1/60 s, mean; m
};

/// The densities over one pattern.
struct MeshScores {
  Pattern pattern;
  std::vector<MeshScore> of_densities;
};

/// What pleat came to at an earlier commit, over the same densities and the pattern of the scene.
struct EarlierCurve {
  std::string name;                                         ///< of the legend
  std::map<std::string, std::vector<TimeAndError>> scenes;  ///< ms, mm
};

/// The scene with its squares' diagonals alternating and one way, and with staggered rows. Rows that are shifted have
/// no particle on a middle line: scenes that pin one are left out.
inline constexpr size_t kPatterns = 3;
std::vector<MeshScores> score_meshes(const pleat_api& api, const RestScene& scene, const pleat_cloth_settings& settings,
                                     const Reference& reference, const std::function<void()>& step);

void print_meshes(const RestScene& scene, const std::vector<MeshScores>& all);
nlohmann::ordered_json meshes_json(const std::vector<MeshScores>& all);

/// Throws InputError where the file is not what it should be.
EarlierCurve read_earlier(const std::filesystem::path& file);
/// A panel a scene, a curve a pattern, and the earlier one.
std::string draw_meshes(const std::vector<const RestScene*>& scenes, const std::vector<std::vector<MeshScores>>& all,
                        const EarlierCurve& earlier);

}  // namespace pleat::bench
