#include "bench/error/contest.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <memory>

#include "bench/metrics/area_samples.h"
#include "bench/metrics/silhouette.h"
#include "demo/scenes/stage_clock.h"

namespace pleat::bench {
namespace {

/// us that this thread has had the processor: all contestants run on one, and other programs must not count.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * double(now.tv_sec) + 1e-3 * double(now.tv_nsec);
}

/// Frame by frame, us.
void time_frames(Contestant& contestant, int frames, std::vector<double>& times) {
  for (int i = 0; i < frames; ++i) {
    const double start = processor_time();
    contestant.run_frame();
    times.push_back(processor_time() - start);
  }
}

/// Of all edges of a garment, how far they are from their length as it was cut.
LengthError edge_error(const demo::TriangleMesh& garment, std::span<const float> particles) {
  std::vector<std::array<uint32_t, 2>> edges;
  for (size_t t = 0; t < garment.triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(garment.triangles[t + k], garment.triangles[t + (k + 1) % 3]);
      edges.push_back({low, high});
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<uint32_t> ends;
  std::vector<float> rest;
  for (const auto& [a, b] : edges) {
    ends.insert(ends.end(), {a, b});
    rest.push_back(float((corner(garment, a) - corner(garment, b)).norm()));
  }
  return length_error(particles, ends, rest);
}

Score measure(const Contestants& one, const Drawing& drawing, const Contestant& running,
              const demo::TriangleMesh& truth) {
  const demo::TriangleMesh drawn = running.surface();
  const std::vector<float> particles = running.particles();
  const Dynamics& dynamics = one.dynamics;
  return {.method = drawing.method,
          .dynamics = dynamics.name,
          .grid = dynamics.grid,
          .drawn_triangles = drawn.triangle_count(),
          .ms = 0.0,
          .error = surface_distance(drawn, truth),
          .silhouette_overlap = silhouette_overlap(drawn, truth, 256),
          .area_error_percent =
              100.0 * (mesh_area(drawn.positions, drawn.triangles) / mesh_area(truth.positions, truth.triangles) - 1.0),
          .edges = edge_error(running.garment(), particles),
          .wrinkles = sheet_spectrum(particles, dynamics.grid.rows, dynamics.grid.columns),
          .peer = dynamics.peer.has_value()};
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
          scores.push_back(measure(all[i], drawing, *running[i], truth));
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
