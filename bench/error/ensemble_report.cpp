// Ensembles as tables, as JSON, and as they are kept in files.
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/error/ensemble.h"
#include "bench/fine_square.h"
#include "demo/input_error.h"
#include "demo/program/output.h"

namespace pleat::bench {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const Scatter& scatter) { return {{"mean", scatter.mean}, {"deviation", scatter.deviation}}; }
Scatter scatter_from(const ordered_json& json) { return {json.at("mean"), json.at("deviation")}; }

ordered_json to_json(const Ensemble& ensemble) {
  ordered_json bands = ordered_json::array();
  for (const Scatter& band : ensemble.wrinkles) bands.push_back(to_json(band));
  return {{"spread_m", ensemble.spread},
          {"lowest_m", to_json(ensemble.lowest)},
          {"deep_m", to_json(ensemble.deep)},
          {"wrinkles_m2", bands}};
}

Ensemble ensemble_from(const ordered_json& json, std::vector<float> mean) {
  Ensemble ensemble{
      std::move(mean), json.at("spread_m"), {}, scatter_from(json.at("lowest_m")), scatter_from(json.at("deep_m"))};
  for (size_t band = 0; band < ensemble.wrinkles.size(); ++band) {
    ensemble.wrinkles[band] = scatter_from(json.at("wrinkles_m2").at(band));
  }
  return ensemble;
}

std::filesystem::path file_of(const std::filesystem::path& folder, const EnsembleScene& scene) {
  return folder / (std::string(scene.cloth.name) + "_ensemble.json");
}

void print_row(const char* method, const char* grid, const Ensemble& one, const Ensemble& truth) {
  const MeanDistance apart = mean_distance(one, truth);
  std::printf("  %-24s %6s %8.1f %8.1f %8.1f   %7.1f +-%5.1f %7.1f +-%5.1f  ", method, grid, 1e3 * apart.rms,
              1e3 * apart.chance, 1e3 * one.spread, 1e3 * one.lowest.mean, 1e3 * one.lowest.deviation,
              1e3 * one.deep.mean, 1e3 * one.deep.deviation);
  for (size_t band = 0; band < one.wrinkles.size(); ++band) {
    std::printf(" %7.2f", one.wrinkles[band].mean / truth.wrinkles[band].mean);
  }
  std::printf("\n");
}

std::string text(Grid grid) { return std::to_string(grid.rows) + "x" + std::to_string(grid.columns); }

}  // namespace

EnsembleReference read_ensemble(const std::filesystem::path& folder, const EnsembleScene& scene) {
  const std::filesystem::path path = file_of(folder, scene);
  const std::string name(scene.cloth.name);
  std::ifstream stream(path);
  if (!stream) throw demo::InputError(path.string(), "cannot be read; the option --regenerate makes it anew");
  try {
    const ordered_json json = ordered_json::parse(stream);
    return {ensemble_from(json.at("fine"), read_fine(folder, name + "_mean")),
            ensemble_from(json.at("half"), read_fine(folder, name + "_mean_half"))};
  } catch (const ordered_json::exception& error) {
    throw demo::InputError(path.string(), error.what());
  }
}

void write_ensemble(const std::filesystem::path& folder, const EnsembleScene& scene,
                    const EnsembleReference& reference) {
  const std::string name(scene.cloth.name);
  write_fine(folder, name + "_mean", reference.fine.mean);
  write_fine(folder, name + "_mean_half", reference.half.mean);
  demo::OutputFile file(file_of(folder, scene));
  file.commit(
      ordered_json{{"members", kMembers}, {"fine", to_json(reference.fine)}, {"half", to_json(reference.half)}}.dump(
          2) +
      "\n");
}

void print_ensembles(const std::vector<EnsembleScores>& all) {
  std::printf(
      "%u starts each. Apart: RMS distance of the mean shape from the reference's, and what it would be by chance;\n"
      "spread: of members about their own mean; lowest point, and front to back, with standard deviations; mm.\n"
      "Energy of waves over the reference's, by wavelength in parts of the side at rest.\n",
      kMembers);
  for (const EnsembleScores& of_scene : all) {
    const EnsembleScene& scene = *of_scene.scene;
    std::printf("\n%s: %s\n  %-24s %6s %8s %8s %8s   %15s %15s   ", scene.cloth.name.data(), scene.cloth.title.data(),
                "", "grid", "apart", "chance", "spread", "lowest", "deep");
    std::printf("%7s", "longer");
    for (const double end : kBandEnds) std::printf(" %7.3g", end);
    std::printf("\n");
    const Ensemble& truth = of_scene.reference.fine;
    const Grid fine = scene.cloth.fine;
    print_row("the reference", text(fine).c_str(), truth, truth);
    print_row("the same, half its mesh", text({(fine.rows + 1) / 2, (fine.columns + 1) / 2}).c_str(),
              of_scene.reference.half, truth);
    for (const EnsembleScore& score : of_scene.scores) {
      print_row(score.method.c_str(), text(score.grid).c_str(), score.ensemble, truth);
    }
  }
}

ordered_json ensembles_json(const std::vector<EnsembleScores>& all) {
  ordered_json scenes = ordered_json::array();
  for (const EnsembleScores& of_scene : all) {
    ordered_json scores = ordered_json::array();
    for (const EnsembleScore& score : of_scene.scores) {
      const MeanDistance apart = mean_distance(score.ensemble, of_scene.reference.fine);
      scores.push_back({{"method", score.method},
                        {"grid", text(score.grid)},
                        {"mean_apart_mm", 1e3 * apart.rms},
                        {"by_chance_mm", 1e3 * apart.chance},
                        {"ensemble", to_json(score.ensemble)}});
    }
    scenes.push_back({{"name", of_scene.scene->cloth.name},
                      {"members", kMembers},
                      {"reference", to_json(of_scene.reference.fine)},
                      {"reference_half", to_json(of_scene.reference.half)},
                      {"scores", scores}});
  }
  return scenes;
}

}  // namespace pleat::bench
