// Cases of what acts from outside on a sheet, and of what must not: air, a slope, internal forces in free flight.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "bench/validation/check.h"
#include "bench/validation/line_fit.h"
#include "bench/validation/rig.h"

namespace pleat::bench {
namespace {

constexpr double kFall = 9.81f, kDensity = 0.2f;

/// n x n particles in the xz plane, `width` m a side.
demo::TriangleMesh sheet(const pleat_api& api, uint32_t n, float width) {
  pleat_shape_def def;
  api.shape_def_init(&def, sizeof def);
  def.rows = def.columns = n;
  def.width = def.depth = width;
  def.alternate = 1;
  demo::TriangleMesh mesh;
  mesh.positions.resize(size_t{3} * n * n);
  mesh.triangles.resize(size_t{6} * (n - 1) * (n - 1));
  api.shape_build(&def, mesh.positions.data(), mesh.triangles.data());
  return mesh;
}

/// Turned about the z axis, so that what was level falls towards -x, and moved.
void incline(std::vector<float>& positions, double angle, double lift) {
  for (size_t i = 0; i < positions.size(); i += 3) {
    const double x = positions[i], y = positions[i + 1] + lift;
    positions[i] = float(x * std::cos(angle) - y * std::sin(angle));
    positions[i + 1] = float(x * std::sin(angle) + y * std::cos(angle));
  }
}

/// Mean velocity up the slope after each of `ticks` ticks of 1/60 s of a sheet that lies on it.
std::vector<double> slide(const pleat_api& api, double angle, int ticks) {
  pleat_cloth_def defaults;
  api.cloth_def_init(&defaults, sizeof defaults);
  RigDef def;
  def.settings = defaults.settings;
  def.settings.friction = 0.3f;
  def.settings.air_damping = 0.0f;
  def.mesh = sheet(api, 6, 0.5f);
  def.body.positions = {-20, 0, -2, 20, 0, -2, 20, 0, 2, -20, 0, 2};
  def.body.triangles = {0, 2, 1, 0, 3, 2};
  incline(def.body.positions, angle, 0.0);
  incline(def.mesh.positions, angle, def.settings.thickness);
  Rig rig(api, def);
  std::vector<double> speeds;
  for (int i = 0; i < ticks; ++i) {
    rig.step(1.0 / 60);
    double sum = 0.0;
    for (uint32_t p = 0; p < rig.count(); ++p) {
      sum += rig.velocity(p)[0] * std::cos(angle) + rig.velocity(p)[1] * std::sin(angle);
    }
    speeds.push_back(sum / rig.count());
  }
  return speeds;
}

struct Momentum {
  Point linear, angular;  ///< kg m/s, kg m2/s about the origin
  double size;            ///< kg m/s, sum of |m v|
};
Momentum momentum_of(const Rig& rig, const std::vector<double>& mass) {
  Momentum sum{};
  for (uint32_t i = 0; i < rig.count(); ++i) {
    const Point x = rig.position(i), v = rig.velocity(i);
    for (size_t k = 0; k < 3; ++k) {
      sum.linear[k] += mass[i] * v[k];
      sum.angular[k] += mass[i] * (x[(k + 1) % 3] * v[(k + 2) % 3] - x[(k + 2) % 3] * v[(k + 1) % 3]);
    }
    sum.size += mass[i] * std::hypot(v[0], v[1], v[2]);
  }
  return sum;
}

}  // namespace

Checks terminal_velocity(const pleat_api& api) {
  constexpr double kAir = 1.225f, kDrag = 1.28f, dt = 1.0 / 480;
  RigDef def;
  def.mesh = sheet(api, 5, 1.0f);
  def.settings = bare_settings(api);
  def.settings.drag_coefficient = float(kDrag);
  Rig rig(api, def);
  const double terminal = std::sqrt(2.0 * kDensity * kFall / (kAir * kDrag));
  Checks checks;
  double discrete = 0.0;
  for (int i = 1; i <= 960; ++i) {
    rig.step(dt);
    discrete += dt * kFall * (1.0 - discrete * discrete / (terminal * terminal));
    const double time = i * dt, measured = -rig.velocity(12)[1];
    if (i != 48 && i != 96 && i != 960) continue;
    const std::string name = "after " + std::to_string(time).substr(0, 3) + " s";
    checks.push_back(relative(name + ", discrete, m/s", discrete, measured, 1e-5));
    checks.push_back(
        absolute(name + ", continuum, m/s", terminal * std::tanh(kFall * time / terminal), measured, 5e-3 * terminal));
  }
  return checks;
}

Checks incline(const pleat_api& api) {
  Checks checks;
  for (const double degrees : {10.0, 16.0}) {
    const std::vector<double> speed = slide(api, degrees * std::numbers::pi / 180, 180);
    checks.push_back(absolute("creep at " + std::to_string(int(degrees)) + " degrees, m/s", 0.0, speed.back(), 1e-6));
  }
  for (const double degrees : {20.0, 30.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const std::vector<double> speed = slide(api, angle, 60);
    const double expected = kFall * (std::sin(angle) - double(0.3f) * std::cos(angle));
    const double measured = -(speed[59] - speed[29]) / 0.5;
    checks.push_back(
        relative("acceleration at " + std::to_string(int(degrees)) + " degrees, m/s2", expected, measured, 1e-2));
  }
  return checks;
}

Checks momentum(const pleat_api& api) {
  Checks checks;
  // A particle's mass: a third of the faces around it.
  const demo::TriangleMesh mesh = sheet(api, 9, 1.0f);
  std::vector<double> mass(mesh.vertex_count(), 0.0);
  for (const uint32_t corner : mesh.triangles) mass[corner] += kDensity / double(mesh.triangle_count()) / 3.0;
  pleat_cloth_def defaults;
  api.cloth_def_init(&defaults, sizeof defaults);
  for (const bool limited : {false, true}) {
    RigDef def;
    def.mesh = mesh;
    def.settings = bare_settings(api);
    def.settings.stiffness = defaults.settings.stiffness;
    def.settings.bend_stiffness = defaults.settings.bend_stiffness;
    def.settings.edge_damping = defaults.settings.edge_damping;
    def.settings.bend_damping = defaults.settings.bend_damping;
    if (limited) def.settings.stretch_limit = defaults.settings.stretch_limit;
    def.gravity = {};
    std::mt19937 random(1);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      def.start_motion.push_back(float(double(random()) / 4294967296.0 - 0.5));
    }
    Rig rig(api, def);
    const Momentum before = momentum_of(rig, mass);
    rig.step(1.0 / 480, 10000);
    const Momentum after = momentum_of(rig, mass);
    const auto drift = [&](const Point& a, const Point& b) {
      return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / before.size;
    };
    const std::string name = limited ? "forces and strain limit, " : "forces, ";
    // Forces round impulses, by 6e-8 of themselves. The strain limit moves positions, right to 6e-8 m: over a step of
    // 1/480 s that is 3e-5 m/s a particle and step; and it turns the edges along which it has pushed.
    const double gate = limited ? 5e-4 : 1e-5;
    checks.push_back(absolute(name + "linear, drift", 0.0, drift(before.linear, after.linear), gate));
    checks.push_back(absolute(name + "angular, drift", 0.0, drift(before.angular, after.angular), gate));
  }
  return checks;
}

}  // namespace pleat::bench
