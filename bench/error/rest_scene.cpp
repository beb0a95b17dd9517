#include "bench/error/rest_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace pleat::bench {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr float kSoft = 5e-5f, kStiff = 1e-3f;  // N m: the library's own; canvas
constexpr double kRadius = 0.2, kThickness = 0.005;
constexpr float kAirDamping = 4.0f;  // 1/s

constexpr std::array<Grid, 4> kSquares = {{{6, 6}, {8, 8}, {16, 16}, {32, 32}}};
constexpr std::array<Grid, 4> kStrips = {{{3, 11}, {4, 17}, {8, 33}, {16, 65}}};  // with a line in the middle
constexpr Grid kFineSquareGrid = {65, 65}, kFinestSquareGrid = {129, 129}, kFineStripGrid = {33, 129};
// Where bending decides. Diagonals of one way bend as the elastica within a percent (error_test), alternating ones
// zigzag; but under tension those of one way are a net that is stronger one way.
constexpr Grid kFineBendingGrid = {33, 129, Pattern::kOneWay};
constexpr std::array<Grid, 4> kBendingStrips = {
    {{3, 11, Pattern::kOneWay}, {4, 17, Pattern::kOneWay}, {8, 33, Pattern::kOneWay}, {16, 65, Pattern::kOneWay}}};

bool at_corner(double u, double v) { return (u == 0.0 || u == 1.0) && (v == 0.0 || v == 1.0); }

constexpr double kReach = kRadius + kThickness, kWrapped = 0.5 * kPi * kReach;  // of the sheet's width, 1 m

/// From the crest around a wider cylinder that touches this one there, then straight down: so wide that few particles,
/// too, begin nearly outside and are not thrown over to the other side.
Vector3d around_cylinder(double u, double v) {
  constexpr double kWider = 1.6 * kReach;
  const double angle = std::min(u / kWider, 0.5 * kPi);
  return {kWider * std::sin(angle), kReach - kWider + kWider * std::cos(angle) - std::max(0.0, u - 0.5 * kPi * kWider),
          v - 0.5};
}

/// Where the wrapped part lies on it.
Vector3d on_cylinder(double u, double v) {
  const double angle = std::min(u / kReach, 0.5 * kPi);
  return {kReach * std::sin(angle), kReach * std::cos(angle) - std::max(0.0, u - kWrapped), v - 0.5};
}

const RestScene kScenes[] = {
    {"two_corners", "square hung from two corners, 1 m apart", 1.0f, 1.0f, kSoft, kSquares, kFinestSquareGrid,
     [](double u, double v) { return (u == 0.0 || u == 1.0) && v == 0.0; },
     [](double u, double v) { return Vector3d(u - 0.5, -v, 0.01 * std::sin(kPi * v)); }, std::nullopt},
    {"bowl", "square hung from four corners, .9 m apart", 1.0f, 1.0f, kStiff, kSquares, kFineSquareGrid, at_corner,
     [](double u, double v) {
       const double sag = 1.0 - (1.0 - std::sin(kPi * u)) * (1.0 - std::sin(kPi * v));
       return Vector3d(0.9 * (u - 0.5), -0.2 * sag, 0.9 * (v - 0.5));
     },
     std::nullopt},
    {"cylinder", "square pinned along the crest of a cylinder, radius .2 m", 1.0f, 1.0f, kSoft, kSquares,
     kFineSquareGrid, [](double u, double) { return u == 0.0; }, around_cylinder,
     demo::CapsulePose{{0.0f, 0.0f, -2.0f}, {0.0f, 0.0f, 2.0f}, float(kRadius)}},
    {"strip", "stiff strip held by its middle line", 1.0f, 0.25f, kStiff, kBendingStrips, kFineBendingGrid,
     [](double u, double) { return u == 0.5; },
     [](double u, double v) { return Vector3d(0.8 * (u - 0.5), -0.6 * std::abs(u - 0.5), 0.25 * (v - 0.5)); },
     std::nullopt},
    {"catenary", "strip hung from both ends, .8 m apart", 1.0f, 0.25f, kSoft, kStrips, kFineStripGrid,
     [](double u, double) { return u == 0.0 || u == 1.0; },
     [](double u, double v) { return Vector3d(0.8 * (u - 0.5), -0.25 * std::sin(kPi * u), 0.25 * (v - 0.5)); },
     std::nullopt},
};

/// Calls `visit(u, v, particle)` for each particle, row by row.
template <class F>
void for_each_particle(Grid grid, F visit) {
  uint32_t particle = 0;
  for (uint32_t row = 0; row < grid.rows; ++row) {
    const uint32_t shifted = grid.pattern == Pattern::kStaggered ? row % 2 : 0, cells = grid.columns - 1;
    for (uint32_t column = 0; column < grid.columns + shifted; ++column) {
      visit(std::clamp((column - 0.5 * shifted) / cells, 0.0, 1.0), double(row) / (grid.rows - 1), particle++);
    }
  }
}

/// A row and the one below it: one has a particle more and begins half an edge before the other.
void add_staggered(uint32_t upper, uint32_t lower, uint32_t columns, bool upper_longer, std::vector<uint32_t>& to) {
  const uint32_t longer = upper_longer ? upper : lower, shorter = upper_longer ? lower : upper;
  for (uint32_t k = 0; k < columns; ++k) {
    if (upper_longer) {
      to.insert(to.end(), {longer + k, shorter + k, longer + k + 1});
    } else {
      to.insert(to.end(), {longer + k, longer + k + 1, shorter + k});
    }
    if (k + 1 == columns) break;
    if (upper_longer) {
      to.insert(to.end(), {shorter + k, shorter + k + 1, longer + k + 1});
    } else {
      to.insert(to.end(), {shorter + k, longer + k + 1, shorter + k + 1});
    }
  }
}

demo::TriangleMesh staggered_sheet(Grid grid, float width, float depth) {
  demo::TriangleMesh mesh;
  for_each_particle(grid, [&](double u, double v, uint32_t) {
    mesh.positions.insert(mesh.positions.end(), {float(u - 0.5) * width, 0.0f, float(v - 0.5) * depth});
  });
  uint32_t upper = 0;
  for (uint32_t row = 0; row + 1 < grid.rows; ++row) {
    const uint32_t lower = upper + grid.columns + row % 2;
    add_staggered(upper, lower, grid.columns, row % 2 == 1, mesh.triangles);
    upper = lower;
  }
  return mesh;
}

demo::TriangleMesh flat_sheet(const pleat_api& api, Grid grid, float width, float depth) {
  if (grid.pattern == Pattern::kStaggered) return staggered_sheet(grid, width, depth);
  pleat_shape_def def;
  api.shape_def_init(&def, sizeof def);
  def.rows = grid.rows;
  def.columns = grid.columns;
  def.width = width;
  def.depth = depth;
  def.alternate = grid.pattern == Pattern::kAlternating ? 1 : 0;
  uint32_t vertices = 0, triangles = 0;
  api.shape_size(&def, &vertices, &triangles);
  demo::TriangleMesh mesh;
  mesh.positions.resize(size_t{3} * vertices);
  mesh.triangles.resize(size_t{3} * triangles);
  if (api.shape_build(&def, mesh.positions.data(), mesh.triangles.data()) != PLEAT_OK) {
    throw std::runtime_error("the library cannot build a sheet of cloth");
  }
  return mesh;
}

}  // namespace

std::span<const RestScene> rest_scenes() { return kScenes; }

RestScene held_on_body(const RestScene& scene) {
  RestScene held = scene;
  held.body.reset();
  held.pinned = [](double u, double) { return u <= kWrapped; };
  held.start = on_cylinder;
  return held;
}

std::vector<float> start_positions(const RestScene& scene, Grid grid) {
  std::vector<float> positions;
  for_each_particle(grid, [&](double u, double v, uint32_t) {
    for (const double coordinate : scene.start(u, v)) positions.push_back(float(coordinate));
  });
  return positions;
}

pleat_cloth_settings rest_settings(const pleat_api& api, const RestScene& scene) {
  pleat_cloth_def def;
  api.cloth_def_init(&def, sizeof def);
  def.settings.bend_stiffness = scene.bend_stiffness;
  def.settings.air_damping = kAirDamping;
  def.settings.friction = 0.0f;
  def.settings.thickness = float(kThickness);
  return def.settings;
}

double stable_substep(const pleat_api& api, const RestScene& scene, Grid grid) {
  // Highest frequencies of an endless lattice of cells of length a; borders are lighter, which the reserve is for.
  const double density = rest_settings(api, scene).density, a = double(scene.width) / (grid.columns - 1);
  const double stretching = 2.45 * std::sqrt(double(kSpring) / density) / a;
  const double bending = 6.93 * std::sqrt(double(scene.bend_stiffness) / density) / (a * a);
  return 0.7 / std::hypot(stretching, bending);
}

demo::SceneDef rest_scene_def(const pleat_api& api, const RestScene& scene, Grid grid,
                              const pleat_cloth_settings& settings, double rate) {
  demo::SceneDef def;
  def.name = std::string(scene.name);
  def.rate = rate;
  def.garment = flat_sheet(api, grid, scene.width, scene.depth);
  def.settings = settings;
  for_each_particle(grid, [&](double u, double v, uint32_t particle) {
    if (scene.pinned(u, v)) def.pins.push_back(particle);
  });
  if (scene.body) def.fixed.push_back({.shape = *scene.body});
  return def;
}

std::vector<float> resampled(std::span<const float> points, Grid from, Grid to) {
  std::vector<float> samples;
  for_each_particle(to, [&](double u, double v, uint32_t) {
    const double x = u * (from.columns - 1), y = v * (from.rows - 1);
    const size_t left = std::min(size_t(x), size_t{from.columns} - 2), low = std::min(size_t(y), size_t{from.rows} - 2);
    const auto at = [&](size_t row, size_t column, size_t axis) {
      return double(points[3 * (row * from.columns + column) + axis]);
    };
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto along = [&](size_t row) {
        return std::lerp(at(row, left, axis), at(row, left + 1, axis), x - double(left));
      };
      samples.push_back(float(std::lerp(along(low), along(low + 1), y - double(low))));
    }
  });
  return samples;
}

std::vector<uint32_t> grid_triangles(const pleat_api& api, Grid grid) {
  return flat_sheet(api, grid, 1.0f, 1.0f).triangles;
}

}  // namespace pleat::bench
