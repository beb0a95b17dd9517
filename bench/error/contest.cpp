#include "bench/error/contest.h"

#include <chrono>
#include <cmath>
#include <memory>

#include "bench/metrics/silhouette.h"
#include "bench/metrics/size_error.h"
#include "demo/scenes/stage_clock.h"

namespace pleat::bench {
namespace {

/// Frame by frame, us.
void time_frames(Contestant& contestant, int frames, std::vector<double>& times) {
  for (int i = 0; i < frames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    contestant.run_frame();
    times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
}

}  // namespace

std::vector<Score> hold_contest(const pleat_api& api, const RestScene& scene, const Reference& reference,
                                const std::vector<Contestants>& all, bool quick, const std::function<void()>& step) {
  std::vector<std::unique_ptr<Contestant>> running;
  for (const Contestants& one : all) {
    running.push_back(std::make_unique<Contestant>(api, scene, one.dynamics));
    settle(*running.back());
    step();
  }

  const demo::TriangleMesh truth = reference_surface(api, reference.fine);
  const double true_area = mesh_area(truth.positions, truth.triangles);
  std::vector<Score> scores;
  std::vector<std::vector<double>> times;  // us, of each score
  const int rounds = quick ? 3 : 5;
  for (int round = 0; round < rounds; ++round) {
    size_t score = 0;
    for (size_t i = 0; i < all.size(); ++i) {
      for (const Drawing& drawing : all[i].drawings) {
        running[i]->draw_as(drawing);
        running[i]->run_frame();  // warm again
        if (round == 0) {
          const demo::TriangleMesh drawn = running[i]->surface();
          scores.push_back({drawing.method, all[i].dynamics.name, all[i].dynamics.grid, drawn.triangle_count(), 0.0,
                            surface_distance(drawn, truth), silhouette_overlap(drawn, truth, 256),
                            100.0 * (mesh_area(drawn.positions, drawn.triangles) / true_area - 1.0),
                            all[i].dynamics.peer.has_value()});
          times.emplace_back();
        }
        time_frames(*running[i], 4, times[score++]);
      }
    }
  }
  for (size_t i = 0; i < scores.size(); ++i) scores[i].ms = 1e-3 * demo::spread_of(times[i]).median;
  return scores;
}

}  // namespace pleat::bench
