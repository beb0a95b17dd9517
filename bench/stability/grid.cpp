#include "bench/stability/grid.h"

#include <algorithm>
#include <cmath>

#include "bench/stability/edges.h"
#include "bench/validation/rig.h"

namespace pleat::bench {
namespace {

constexpr uint32_t kIntegrators[] = {PLEAT_INTEGRATOR_SYMPLECTIC_EULER, PLEAT_INTEGRATOR_EXPLICIT_EULER,
                                     PLEAT_INTEGRATOR_RUNGE_KUTTA_4, PLEAT_INTEGRATOR_PROJECTED,
                                     PLEAT_INTEGRATOR_IMPLICIT_EULER};

/// The cloth's particles that lie as far in z as the last one: the border opposite the pins.
std::vector<float> hem_weights(const demo::TriangleMesh& mesh, double added) {
  std::vector<float> mass(mesh.vertex_count(), 0.0f);
  for (size_t i = 0; i < mass.size(); ++i) {
    if (mesh.positions[3 * i + 2] == mesh.positions.back()) mass[i] = float(added);
  }
  return mass;
}

/// Of the particle farthest from the origin, m; infinite where one is not finite.
double reach(const Rig& rig) {
  double farthest = 0.0;
  for (uint32_t i = 0; i < rig.count(); ++i) {
    const Point x = rig.position(i), v = rig.velocity(i);
    const double r = std::hypot(x[0], x[1], x[2]);
    if (!std::isfinite(r) || !std::isfinite(std::hypot(v[0], v[1], v[2]))) return INFINITY;
    farthest = std::max(farthest, r);
  }
  return farthest;
}

Fate fate_of(double strain) {
  return strain < 0.1   ? Fate::kBelow10
         : strain < 1.0 ? Fate::k10To100
         : strain < 10. ? Fate::k100To1000
                        : Fate::kAbove1000;
}

}  // namespace

Cell StabilityGrid::cell(size_t index) const {
  const auto next = [&index](const auto& axis) {
    const size_t i = index % axis.size();
    index /= axis.size();
    return axis[i];
  };
  Cell cell{};
  cell.stiffness = next(stiffness);
  cell.rate = next(rate);
  cell.mass_ratio = next(mass_ratio);
  cell.gravity = next(gravity);
  cell.integrator = next(integrators);
  return cell;
}

StabilityGrid full_grid() {
  return {.integrators = {std::begin(kIntegrators), std::end(kIntegrators)},
          .stiffness = {1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7},
          .rate = {240, 120, 60, 30, 15, 10},
          .mass_ratio = {1, 10, 100, 1e3, 1e4},
          .gravity = {1, 10, 100},
          .seconds = 2.0};
}

StabilityGrid quick_grid() {
  return {.integrators = full_grid().integrators,
          .stiffness = {1e-2, 1e7},
          .rate = {240, 10},
          .mass_ratio = {1e4},
          .gravity = {1, 100},
          .seconds = 1.0};
}

CellResult run_cell(const pleat_api& api, const demo::SceneDef& scene, const Cell& cell, double seconds) {
  constexpr double kFarAway = 1000.0;  // m
  RigDef def;
  def.mesh = scene.garment;
  def.pins = scene.pins;
  pleat_cloth_def defaults;
  api.cloth_def_init(&defaults, sizeof defaults);
  def.settings = defaults.settings;
  def.settings.surface = PLEAT_SURFACE_FLAT;  // only the particles are looked at
  def.settings.level = 1;
  def.settings.integrator = cell.integrator;
  def.settings.stiffness = float(cell.stiffness);
  def.gravity = {0.0f, float(-9.81 * cell.gravity), 0.0f};
  const double own = double(def.settings.density) / double(scene.garment.vertex_count());  // of a square of 1 m2
  def.added_mass = hem_weights(scene.garment, own * (cell.mass_ratio - 1.0));

  Rig rig(api, def);
  const int ticks = int(std::lround(seconds * cell.rate));
  for (int i = 0; i < ticks; ++i) {
    rig.step(1.0 / cell.rate);
    const double far = reach(rig);
    if (!std::isfinite(far)) return {Fate::kNonfinite};
    if (far > kFarAway) return {Fate::kFarAway};
  }
  const double strain = Edges(api, rig).largest_strain(rig);
  return {fate_of(strain), strain};
}

}  // namespace pleat::bench
