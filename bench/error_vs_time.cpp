// The program `error_vs_time`: how far from the truth cloth comes to rest, for what it costs a frame.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/error/dominant.h"
#include "bench/error/ensemble.h"
#include "bench/error/meshes.h"
#include "bench/error/scoreboard.h"
#include "bench/fine_square.h"
#include "bench/machine.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/program/progress.h"
#include "demo/scenes/settings.h"

namespace {

using namespace pleat::bench;
namespace demo = pleat::demo;

/// A scene to compete in, its truth, and our settings there.
struct Arena {
  const RestScene* scene;
  Reference reference;
  pleat_cloth_settings settings;
};

/// Solves the scenes' references anew and says how far they came to rest, and what shorter steps would change.
void regenerate(const pleat_api& api, const std::filesystem::path& folder,
                const std::vector<const RestScene*>& scenes) {
  for (const RestScene* scene : scenes) {
    ReferenceSolution solution;
    {
      constexpr uint32_t kSteps = 1000;
      demo::Progress progress("solving " + std::string(scene->name) + ", per mille", kSteps);
      uint32_t shown = 0;
      solution = solve_reference(api, *scene, [&](double share) {
        for (; shown < uint32_t(share * kSteps); ++shown) progress.step();
      });
    }
    write_reference(folder, *scene, solution.reference);
    std::printf("%-12s moved by at most %.2g mm in the last quarter second; steps half as long: RMS %.2g mm\n",
                std::string(scene->name).c_str(), 1e3 * solution.motion, 1e3 * solution.step_rms);
  }
}

std::vector<Arena> arenas(const pleat_api& api, const std::filesystem::path& folder,
                          const std::vector<const RestScene*>& scenes, const std::vector<std::string>& changes) {
  std::vector<Arena> all;
  for (const RestScene* scene : scenes) {
    all.push_back({scene, read_reference(folder, *scene), rest_settings(api, *scene)});
    for (const std::string& change : changes) demo::apply_option(change, all.back().settings);
  }
  return all;
}

std::vector<SceneScores> compete(const pleat_api& api, const std::vector<Arena>& all, bool quick) {
  std::vector<std::vector<Contestants>> fields;
  size_t total = 0;
  for (const Arena& arena : all) {
    fields.push_back(contestants(api, *arena.scene, arena.settings, quick));
    total += fields.back().size();
  }
  demo::Progress progress("coming to rest, contestant", uint32_t(total));
  std::vector<SceneScores> scores;
  for (size_t i = 0; i < all.size(); ++i) {
    const auto& [scene, reference, settings] = all[i];
    const SurfaceDistance halving =
        surface_distance(reference_surface(api, reference.half), reference_surface(api, reference.fine));
    scores.push_back({scene, halving, sheet_spectrum(reference.fine, kFineSide, kFineSide),
                      hold_contest(api, *scene, reference, fields[i], quick, [&] { progress.step(); })});
  }
  return scores;
}

/// Where the error comes from, at 66, 264 and 1056 particles; with `quick` at the first of these.
nlohmann::ordered_json blame(const pleat_api& api, const std::vector<Arena>& all, bool quick) {
  const size_t last = quick ? 2 : 4;
  std::vector<std::vector<Blame>> blames;
  {
    demo::Progress progress("swapping parts, density", uint32_t(all.size() * (last - 1)));
    for (const auto& [scene, reference, settings] : all) {
      std::vector<Blame>& of_grids = blames.emplace_back();
      for (size_t i = 1; i < last; ++i) {
        of_grids.push_back(blame_parts(api, *scene, settings, reference, scene->coarse[i]));
        progress.step();
      }
    }
  }
  nlohmann::ordered_json figures;
  for (size_t i = 0; i < all.size(); ++i) {
    print_blame(*all[i].scene, blames[i]);
    figures[std::string(all[i].scene->name)] = blame_json(blames[i]);
  }
  return figures;
}

/// Pleat alone over meshes of several patterns; draws them where `svg` is.
nlohmann::ordered_json over_meshes(const pleat_api& api, const std::vector<const RestScene*>& scenes,
                                   const std::vector<Arena>& all, demo::OutputOption& svg) {
  std::optional<EarlierCurve> earlier;
  if (svg) earlier = read_earlier(std::filesystem::path(PLEAT_FINE_DIR) / "earlier.json");
  std::vector<std::vector<MeshScores>> scores;
  {
    demo::Progress progress("over meshes, pattern", uint32_t(all.size() * kPatterns));
    for (const auto& [scene, reference, settings] : all) {
      scores.push_back(score_meshes(api, *scene, settings, reference, [&] { progress.step(); }));
    }
  }
  nlohmann::ordered_json figures;
  for (size_t i = 0; i < scenes.size(); ++i) {
    print_meshes(*scenes[i], scores[i]);
    figures[std::string(scenes[i]->name)] = meshes_json(scores[i]);
  }
  if (earlier) svg.commit(draw_meshes(scenes, scores, *earlier));
  return figures;
}

/// Solves the ensembles' references anew.
void regenerate_ensembles(const pleat_api& api, const std::filesystem::path& folder) {
  demo::Progress progress("solving, start", uint32_t(2 * kMembers * ensemble_scenes().size()));
  for (const EnsembleScene& scene : ensemble_scenes()) {
    write_ensemble(folder, scene, solve_ensemble(api, scene, [&] { progress.step(); }));
  }
}

nlohmann::ordered_json of_many_starts(const pleat_api& api, const std::filesystem::path& folder,
                                      const std::vector<std::string>& changes, bool quick) {
  std::vector<EnsembleReference> references;
  for (const EnsembleScene& scene : ensemble_scenes()) references.push_back(read_ensemble(folder, scene));
  std::vector<EnsembleScores> all;
  {
    demo::Progress progress("from many starts, start", uint32_t(ensemble_scenes().size()) * ensemble_steps(quick));
    for (size_t i = 0; i < references.size(); ++i) {
      pleat_cloth_settings settings = ensemble_settings(api, ensemble_scenes()[i]);
      for (const std::string& change : changes) demo::apply_option(change, settings);
      all.push_back(
          score_ensemble(api, ensemble_scenes()[i], settings, references[i], quick, [&] { progress.step(); }));
    }
  }
  print_ensembles(all);
  return ensembles_json(all);
}

int run_program(int argc, char** argv) {
  CLI::App app(
      "How far from the truth cloth comes to rest, for what a frame costs: on scenes that come to rest in one way "
      "only,\n"
      "our surfaces, integrators and densities, the same drawn flat and finer, and Bullet's soft body, in turn.",
      "error_vs_time");
  bool quick = false, again = false, dominant = false, ensembles = false, meshes = false;
  std::vector<std::string> words, known, changes;
  for (const RestScene& scene : rest_scenes()) known.emplace_back(scene.name);
  std::filesystem::path folder = PLEAT_FINE_DIR;
  app.add_flag("--quick", quick, "two densities and fewer methods");
  auto* scene_option = app.add_option("--scene", words, "only this one; may be repeated")
                           ->type_name("NAME")
                           ->check(CLI::IsMember(known));
  auto* dominant_flag =
      app.add_flag("--dominant", dominant, "instead, where pleat's error comes from: one part at a time made perfect");
  auto* ensembles_flag = app.add_flag("--ensembles", ensembles,
                                      "instead, cloth that buckles or moves, of which only what is common to many "
                                      "starts can be compared")
                             ->excludes(dominant_flag)
                             ->excludes(scene_option);
  app.add_flag(
         "--meshes", meshes,
         "instead, pleat alone over meshes of several patterns; --svg draws it as it was at an earlier commit, too")
      ->excludes(dominant_flag)
      ->excludes(ensembles_flag);
  demo::OutputOption svg(app, "--svg", "draw the curves");
  svg.option().excludes(dominant_flag)->excludes(ensembles_flag);
  demo::OutputOption json(app, "--json", "write the figures for scripts");
  app.add_option("--set", changes, "a setting of our cloths, see `pleat list`")->type_name("KEY=VALUE");
  app.add_option("--fine", folder, "where the references are")->type_name("DIR")->capture_default_str();
  app.add_flag("--regenerate", again, "compute the references anew and keep them there, no more")
      ->excludes(&json.option())
      ->excludes(&svg.option());
  if (const auto status = demo::parse(app, argc, argv)) return *status;

  const pleat_api& api = demo::library();
  std::vector<const RestScene*> scenes;
  for (const RestScene& scene : rest_scenes()) {
    if (words.empty() || std::ranges::find(words, scene.name) != words.end()) scenes.push_back(&scene);
  }
  if (again) {
    require_folder(folder);
    ensembles ? regenerate_ensembles(api, folder) : regenerate(api, folder, scenes);
    return 0;
  }
  json.open();
  svg.open();
  nlohmann::ordered_json figures = {{"quick", quick}, {"set", changes}};
  if (ensembles) {
    figures["ensembles"] = of_many_starts(api, folder, changes, quick);
    figures["machine"] = describe_machine(api);
    json.commit(figures);
    return 0;
  }
  const std::vector<Arena> all = arenas(api, folder, scenes, changes);
  if (dominant) {
    figures["dominant"] = blame(api, all, quick);
  } else if (meshes) {
    figures["meshes"] = over_meshes(api, scenes, all, svg);
  } else {
    const std::vector<SceneScores> scores = compete(api, all, quick);
    print_scores(scores);
    svg.commit(draw_scores(scores));
    figures["scenes"] = scores_json(scores);
  }
  figures["machine"] = describe_machine(api);
  json.commit(figures);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return demo::run_main("error_vs_time", [=] { return run_program(argc, argv); });
}
