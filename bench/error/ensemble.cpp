#include "bench/error/ensemble.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "bench/bare_springs.h"
#include "bench/error/field.h"
#include "bench/fine_square.h"

namespace pleat::bench {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr float kSoft = 5e-5f;  // N m, the library's own
constexpr Grid kKept = {kFineSide, kFineSide};
constexpr Grid kFine = {57, 57};  // each triangle of the 8 x 8 grid in 64
constexpr std::array<Grid, 4> kGrids = {{{6, 6}, {8, 8}, {16, 16}, {32, 32}}};
constexpr uint32_t kSampled = 4;  // the level that is looked at: eight steps along an edge

/// Hanging in a half wave across each span of the upper edge, as deep as the cloth is wide.
Vector3d slack(double u, double v) {
  constexpr double kChord = 0.8, kHeight = 0.27679;  // of a half sine wave 1 m long
  return {kChord * (u - 0.5), -v, kHeight * std::sin(kPi * u) + 0.01 * std::sin(kPi * v)};
}
Vector3d swags(double u, double v) {
  constexpr double kChord = 0.8, kHeight = 0.1384;  // of two, .5 m each
  return {kChord * (u - 0.5), -v, kHeight * std::abs(std::sin(2.0 * kPi * u)) + 0.01 * std::sin(kPi * v)};
}

const EnsembleScene kScenes[] = {
    {{"slack", "square hung from two corners, .8 m apart", 1.0f, 1.0f, kSoft, kGrids, kFine,
      [](double u, double v) { return (u == 0.0 || u == 1.0) && v == 0.0; }, slack, std::nullopt},
     3.0,
     4.0f,
     true},
    {{"swags",
      "square whose upper edge hangs slack from its ends, .8 m apart, and its middle",
      1.0f,
      1.0f,
      kSoft,
      {{{5, 7}, {8, 9}, {16, 17}, {32, 33}}},
      {57, 65},
      [](double u, double v) { return (u == 0.0 || u == 0.5 || u == 1.0) && v == 0.0; },
      swags,
      std::nullopt},
     3.0,
     4.0f,
     true},
    {{"swing", "square let go level, pinned by two corners, after 1 s", 1.0f, 1.0f, kSoft, kGrids, kFine,
      [](double u, double v) { return (u == 0.0 || u == 1.0) && v == 0.0; },
      [](double u, double v) { return Vector3d(u - 0.5, 0.0, v); }, std::nullopt},
     1.0,
     0.1f,
     false}};

/// Where the vertices of a drawn sheet lie in a grid of points evenly spaced at rest.
class DrawnGrid {
 public:
  /// `flat`: as drawn where the particles lie as they were cut, along x and z.
  DrawnGrid(const demo::TriangleMesh& flat, Grid particles, uint32_t level)
      : grid_{2 * level * (particles.rows - 1) + 1, 2 * level * (particles.columns - 1) + 1} {
    const auto ends = [&](size_t axis) {
      std::array<float, 2> e = {flat.positions[axis], flat.positions[axis]};
      for (size_t i = axis; i < flat.positions.size(); i += 3) {
        e = {std::min(e[0], flat.positions[i]), std::max(e[1], flat.positions[i])};
      }
      return e;
    };
    const auto x = ends(0), z = ends(2);
    for (size_t i = 0; i < flat.positions.size(); i += 3) {
      const auto column = std::lround((flat.positions[i] - x[0]) / (x[1] - x[0]) * float(grid_.columns - 1));
      const auto row = std::lround((flat.positions[i + 2] - z[0]) / (z[1] - z[0]) * float(grid_.rows - 1));
      places_.push_back(size_t(row) * grid_.columns + size_t(column));
    }
  }

  /// At the points of an Ensemble.
  std::vector<float> points(std::span<const float> drawn) const {
    std::vector<float> sorted(size_t{3} * grid_.particles());
    for (size_t i = 0; i < places_.size(); ++i) std::copy_n(&drawn[3 * i], 3, &sorted[3 * places_[i]]);
    return resampled(sorted, grid_, kKept);
  }

 private:
  Grid grid_;
  std::vector<size_t> places_;  // of each vertex
};

DrawnGrid drawn_grid(const pleat_api& api, const EnsembleScene& scene, const Dynamics& dynamics) {
  Contestant sheet(api, scene.cloth, dynamics);
  sheet.draw_as({"flat", PLEAT_SURFACE_FLAT, kSampled});
  sheet.place(sheet.garment().positions);
  return {sheet.surface(), dynamics.grid, kSampled};
}

}  // namespace

std::span<const EnsembleScene> ensemble_scenes() { return kScenes; }

pleat_cloth_settings ensemble_settings(const pleat_api& api, const EnsembleScene& scene) {
  pleat_cloth_settings settings = rest_settings(api, scene.cloth);
  settings.air_damping = scene.air_damping;
  return settings;
}

std::vector<float> perturbed_start(const RestScene& scene, Grid grid, uint32_t seed) {
  constexpr int kWaves = 4;
  constexpr double kAmplitude = 0.004;  // m
  std::mt19937 random(seed);
  std::array<std::array<double, kWaves>, kWaves> height{};
  for (auto& along : height) {
    for (double& h : along) h = kAmplitude * (2.0 * double(random() >> 8) / double(1 << 24) - 1.0);
  }
  std::vector<float> positions = start_positions(scene, grid);
  for (uint32_t row = 0; row < grid.rows; ++row) {
    for (uint32_t column = 0; column < grid.columns; ++column) {
      const double u = double(column) / (grid.columns - 1), v = double(row) / (grid.rows - 1);
      if (scene.pinned(u, v)) continue;
      double away = 0.0;
      for (int i = 0; i < kWaves; ++i) {
        for (int j = 0; j < kWaves; ++j) {
          away += height[size_t(i)][size_t(j)] * std::cos(i * kPi * u) * std::sin((j + 0.5) * kPi * v);
        }
      }
      // Across the sheet: y where it starts level, else z.
      const size_t axis = scene.start(0.5, 1.0).y() > -0.5 ? 1 : 2;
      positions[3 * (size_t{row} * grid.columns + column) + axis] += float(away);
    }
  }
  return positions;
}

Scatter scatter_of(std::span<const double> values) {
  const auto n = double(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, std::sqrt(squares / (n - 1.0))};
}

Ensemble summarize(std::span<const std::vector<float>> shapes) {
  const size_t count = shapes[0].size();
  Ensemble all{};
  for (size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (const std::vector<float>& shape : shapes) sum += double(shape[i]);
    all.mean.push_back(float(sum / double(shapes.size())));
  }
  double squares = 0.0;
  std::vector<double> lowest, deep;
  std::array<std::vector<double>, std::tuple_size_v<WrinkleSpectrum>> bands;
  for (const std::vector<float>& shape : shapes) {
    double low = 0.0, rear = 1e9, front = -1e9;
    for (size_t i = 0; i < count; ++i) {
      squares += std::pow(double(shape[i]) - double(all.mean[i]), 2);
      if (i % 3 == 1) low = std::min(low, double(shape[i]));
      if (i % 3 == 2) rear = std::min(rear, double(shape[i])), front = std::max(front, double(shape[i]));
    }
    lowest.push_back(low);
    deep.push_back(front - rear);
    const WrinkleSpectrum spectrum = sheet_spectrum(shape, kFineSide, kFineSide);
    for (size_t band = 0; band < spectrum.size(); ++band) bands[band].push_back(spectrum[band]);
  }
  all.spread = std::sqrt(squares / (double(count) / 3.0 * double(shapes.size() - 1)));
  all.lowest = scatter_of(lowest);
  all.deep = scatter_of(deep);
  for (size_t band = 0; band < bands.size(); ++band) all.wrinkles[band] = scatter_of(bands[band]);
  return all;
}

std::vector<Ensemble> run_members(const pleat_api& api, const EnsembleScene& scene, const Dynamics& dynamics,
                                  const std::vector<Drawing>& drawings, const std::function<void()>& step) {
  const DrawnGrid grid = drawn_grid(api, scene, dynamics);
  std::vector<std::vector<std::vector<float>>> shapes(drawings.size());  // of each drawing and member
  const auto frames = int(std::lround(scene.seconds / kFrame));
  for (uint32_t seed = 1; seed <= kMembers; ++seed) {
    Contestant member(api, scene.cloth, dynamics);
    member.place(perturbed_start(scene.cloth, dynamics.grid, seed));
    for (int frame = 0; frame < frames; ++frame) member.run_frame();
    for (size_t k = 0; k < drawings.size(); ++k) {
      Drawing drawing = drawings[k];
      drawing.level = kSampled;
      member.draw_as(drawing);
      shapes[k].push_back(grid.points(member.surface().positions));
    }
    step();
  }
  std::vector<Ensemble> ensembles;
  for (const auto& of_drawing : shapes) ensembles.push_back(summarize(of_drawing));
  return ensembles;
}

EnsembleReference solve_ensemble(const pleat_api& api, const EnsembleScene& scene, const std::function<void()>& step) {
  const auto solve = [&](Grid grid) {
    Dynamics dynamics = explicit_springs(api, scene.cloth, grid, ensemble_settings(api, scene));
    if (scene.rests) damp_to_rest(dynamics.settings);
    return run_members(api, scene, dynamics, {{"flat", PLEAT_SURFACE_FLAT, 1}}, step)[0];
  };
  const Grid fine = scene.cloth.fine;
  return {solve(fine), solve({fine.rows / 2 + 1, fine.columns / 2 + 1})};
}

MeanDistance mean_distance(const Ensemble& a, const Ensemble& b) {
  double squares = 0.0;
  for (size_t i = 0; i < a.mean.size(); ++i) squares += std::pow(double(a.mean[i]) - double(b.mean[i]), 2);
  return {std::sqrt(squares / (double(a.mean.size()) / 3.0)), std::hypot(a.spread, b.spread) / std::sqrt(kMembers)};
}

uint32_t ensemble_steps(bool quick) { return kMembers * 2 * (quick ? 1 : 3); }

EnsembleScores score_ensemble(const pleat_api& api, const EnsembleScene& scene, const pleat_cloth_settings& settings,
                              const EnsembleReference& reference, bool quick, const std::function<void()>& step) {
  const Drawing flat = {"flat", PLEAT_SURFACE_FLAT, 1}, pleat = {"pleat", PLEAT_SURFACE_PLEAT, 1};
  EnsembleScores all{&scene, reference, {}};
  for (size_t i = 1; i < (quick ? 2u : 4u); ++i) {
    const Grid grid = scene.cloth.coarse[i];
    const std::vector<Ensemble> ours = run_members(api, scene, {"default", grid, settings, {}}, {pleat, flat}, step);
    const Dynamics springs = explicit_springs(api, scene.cloth, grid, settings);
    all.scores.push_back({"pleat", grid, ours[0]});
    all.scores.push_back({"flat, same dynamics", grid, ours[1]});
    all.scores.push_back({"flat, explicit springs", grid, run_members(api, scene, springs, {flat}, step)[0]});
  }
  return all;
}

}  // namespace pleat::bench
