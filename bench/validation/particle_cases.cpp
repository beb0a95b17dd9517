// Cases of a single triangle of cloth: a falling body, a vibration of one degree of freedom, a pendulum.
#include <cmath>
#include <numbers>

#include "bench/validation/check.h"
#include "bench/validation/line_fit.h"
#include "bench/validation/rig.h"
#include "bench/validation/spring_net.h"

namespace pleat::bench {
namespace {

constexpr double kFall = 9.81f, kDensity = 0.2f;

struct Scheme {
  const char* name;
  uint32_t integrator;
};
constexpr Scheme kSymplectic{"symplectic Euler", PLEAT_INTEGRATOR_SYMPLECTIC_EULER};
constexpr Scheme kExplicit{"explicit Euler", PLEAT_INTEGRATOR_EXPLICIT_EULER};
constexpr Scheme kRungeKutta{"Runge-Kutta 4", PLEAT_INTEGRATOR_RUNGE_KUTTA_4};
constexpr Scheme kProjected{"projected", PLEAT_INTEGRATOR_PROJECTED};
constexpr Scheme kImplicit{"implicit Euler", PLEAT_INTEGRATOR_IMPLICIT_EULER};
constexpr Scheme kSchemes[] = {kSymplectic, kExplicit, kRungeKutta, kProjected, kImplicit};

// An equilateral triangle that breathes: its corners move along the medians, so that the length l of its sides is the
// one degree of freedom, m l'' = -3 k (l/L - 1) l. Sides of 1 m.
constexpr double kSpring = 1000.0;
const double kCorner = kDensity * std::sqrt(3.0) / 12.0;  // kg
const double kOmega = std::sqrt(3.0 * kSpring / kCorner);

demo::TriangleMesh triangle(double scale) {
  const double r = scale / std::sqrt(3.0);
  demo::TriangleMesh mesh;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 3.0;
    mesh.positions.insert(mesh.positions.end(), {float(r * std::sin(angle)), 0.0f, float(r * std::cos(angle))});
  }
  mesh.triangles = {0, 1, 2};
  return mesh;
}

RigDef breathing(const pleat_api& api, uint32_t integrator, double amplitude) {
  RigDef def;
  def.mesh = triangle(1.0);
  def.start = triangle(1.0 + amplitude).positions;
  def.gravity = {};
  def.settings = bare_settings(api);
  def.settings.stiffness = float(kSpring);
  def.settings.integrator = integrator;
  return def;
}

SpringNet breathing_net(double amplitude) {
  SpringNet net = net_of_triangle(triangle(1.0), {}, kDensity, kSpring);
  for (Point& p : net.position) {
    for (double& x : p) x *= 1.0 + amplitude;
  }
  return net;
}

/// Elongation, and rate of elongation over omega: the state in the phase plane. Corner 0 lies in +z.
struct Phase {
  double x, y;
};
Phase phase(const Point& corner, const Point& motion) {
  return {std::sqrt(3.0) * corner[2] - 1.0, std::sqrt(3.0) * motion[2] / kOmega};
}
Phase phase(const Rig& rig) { return phase(rig.position(0), rig.velocity(0)); }
Phase phase(const SpringNet& net) { return phase(net.position[0], net.velocity[0]); }
double apart(const Phase& a, const Phase& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// What the differential equation says after `time`.
Phase solution(double amplitude, double time) {
  SpringNet net = breathing_net(amplitude);
  const int steps = int(std::ceil(kOmega * time / 0.005));
  for (int i = 0; i < steps; ++i) net.step(time / steps, PLEAT_INTEGRATOR_RUNGE_KUTTA_4);
  return phase(net);
}

/// Mean of `count` periods of what `advance` returns after each step of dt, from one rise through zero to a later one.
template <class Advance>
double period(int count, double dt, const Advance& advance) {
  double before = 1.0, first = 0.0;
  for (int i = 1, rises = 0;; ++i) {
    const double now = advance();
    if (before < 0.0 && now >= 0.0) {
      const double time = dt * (i - now / (now - before));
      if (rises == 0) first = time;
      if (rises++ == count) return (time - first) / count;
    }
    before = now;
  }
}

/// Slope of log |error| against log dt.
double slope_of(std::span<const double> dt, std::span<const double> error) {
  std::vector<double> x, y;
  for (const double d : dt) x.push_back(std::log(d));
  for (const double e : error) y.push_back(std::log(std::abs(e)));
  return fit_line(x, y).slope;
}

double true_period(double amplitude) {
  SpringNet net = breathing_net(amplitude);
  const double dt = 0.01 / kOmega;
  return period(1, dt, [&] { return net.step(dt, PLEAT_INTEGRATOR_RUNGE_KUTTA_4), phase(net).x; });
}

}  // namespace

Checks free_fall(const pleat_api& api) {
  constexpr int kSteps = 512;
  constexpr double dt = 1.0 / kSteps;
  Checks checks;
  for (const Scheme& scheme : kSchemes) {
    RigDef def = breathing(api, scheme.integrator, 0.0);
    def.gravity = {0.0f, float(-kFall), 0.0f};
    Rig rig(api, def);
    rig.step(dt, kSteps);
    const double error = scheme.integrator == PLEAT_INTEGRATOR_EXPLICIT_EULER  ? -dt
                         : scheme.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4 ? 0.0
                                                                               : dt;
    const double fallen = -rig.position(0)[1];
    // The same increment is rounded the same way in every step while the velocity stays within a factor of two: the
    // errors of 6e-8 add up, those of the last steps the most.
    checks.push_back(relative(std::string(scheme.name) + ", discrete, m", 0.5 * kFall * (1.0 + error), fallen, 1e-5));
    checks.push_back(relative(std::string(scheme.name) + ", continuum, m", 0.5 * kFall, fallen, dt + 1e-5));
  }
  return checks;
}

Checks oscillator(const pleat_api& api) {
  constexpr double kAmplitude = 0.01, kOmegaDt = 0.1;
  constexpr int kPeriods = 100;
  const double dt = double(float(kOmegaDt / kOmega));  // as the library takes it
  Rig rig(api, breathing(api, PLEAT_INTEGRATOR_SYMPLECTIC_EULER, kAmplitude));
  SpringNet net = breathing_net(kAmplitude);
  const auto symplectic = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
  const double ours = period(kPeriods, dt, [&] { return rig.step(dt), phase(rig).x; });
  const double same = period(kPeriods, dt, [&] { return net.step(dt, symplectic), phase(net).x; });
  const double truth = true_period(kAmplitude);
  // A position of 1 m is held to 6e-8 m, the amplitude is 1e-2 m: 6e-6 a step, which adds up like a random walk.
  return {relative("100 periods, discrete, s", same, ours, 2e-6),
          relative("100 periods, continuum, s", truth, ours, 1.1 * kOmegaDt * kOmegaDt / 24.0)};
}

Checks order(const pleat_api& api) {
  Checks checks;
  constexpr double kPhase = 20.0;  // rad
  // Runge-Kutta's error falls below single precision soon: it needs large steps and a large amplitude. Implicit Euler
  // damps with rate omega^2 dt: it needs small ones. So does the projected one, but what it adds to velocities is
  // rounded like positions, by 6e-8 / (omega dt) of them a step: below omega dt = 0.01 nothing else is seen.
  struct Study {
    const Scheme& scheme;
    double amplitude, coarsest, order;
  };
  for (const Study& study :
       {Study{kSymplectic, 0.05, 0.05, 1.0}, Study{kExplicit, 0.05, 0.01, 1.0}, Study{kRungeKutta, 0.1, 0.4, 4.0},
        Study{kImplicit, 0.05, 0.005, 1.0}, Study{kProjected, 0.2, 0.02, 1.0}}) {
    const double time = kPhase / kOmega;
    const int least = int(std::lround(kPhase / study.coarsest));
    const Phase truth = solution(study.amplitude, time);
    std::vector<double> dts, errors;
    for (const double finer : {1.0, 1.5, 2.0}) {
      const int steps = int(std::lround(least * finer));
      Rig rig(api, breathing(api, study.scheme.integrator, study.amplitude));
      rig.step(time / steps, steps);
      dts.push_back(time / steps);
      errors.push_back(apart(phase(rig), truth));
    }
    checks.push_back(
        absolute(std::string(study.scheme.name) + ", order of the state", study.order, slope_of(dts, errors), 0.1));
  }
  std::vector<double> dts, errors;
  for (const double omega_dt : {0.1, 0.2, 0.4}) {
    Rig rig(api, breathing(api, PLEAT_INTEGRATOR_SYMPLECTIC_EULER, 0.01));
    const double dt = double(float(omega_dt / kOmega));
    dts.push_back(dt);
    errors.push_back(period(20, dt, [&] { return rig.step(dt), phase(rig).x; }) - true_period(0.01));
  }
  checks.push_back(absolute("symplectic Euler, order of the phase", 2.0, slope_of(dts, errors), 0.1));
  return checks;
}

Checks pendulum(const pleat_api& api) {
  // One triangle, two of its corners pinned: the third swings around the line between them, 1 m away from it.
  constexpr double kStiff = 2e4, dt = 1.0 / 4096, kPeriod = 2.00607;
  constexpr int kPeriods = 10;
  demo::TriangleMesh mesh;
  mesh.positions = {-0.1f, 0.0f, 0.0f, 0.1f, 0.0f, 0.0f, 0.0f, -1.0f, 0.0f};
  mesh.triangles = {0, 1, 2};
  Checks checks;
  for (const auto& [degrees, factor] : {std::pair{5.0, 1.000476}, std::pair{10.0, 1.001907}, std::pair{30.0, 1.017409},
                                        std::pair{60.0, 1.073182}, std::pair{90.0, 1.180341}}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    RigDef def;
    def.mesh = mesh;
    def.pins = {0, 1};
    def.start = mesh.positions;
    def.start[7] = float(-std::cos(angle)), def.start[8] = float(-std::sin(angle));
    def.settings = bare_settings(api);
    def.settings.stiffness = float(kStiff);
    Rig rig(api, def);
    SpringNet net = net_of_triangle(mesh, def.pins, kDensity, kStiff);
    net.gravity = kFall;
    net.position[2] = rig.position(2);
    const double ours = period(kPeriods, dt, [&] { return rig.step(dt), rig.position(2)[2]; });
    const auto symplectic = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
    const double same = period(kPeriods, dt, [&] { return net.step(dt, symplectic), net.position[2][2]; });
    const std::string name = std::to_string(int(degrees)) + " degrees";
    checks.push_back(relative(name + ", discrete, s", same, ours, 2e-5));
    checks.push_back(relative(name + ", continuum, s", factor * kPeriod, ours, 1e-3));
  }
  return checks;
}

Checks energy(const pleat_api& api) {
  constexpr double kAmplitude = 0.1, kOmegaDt = 0.2;
  constexpr int kSteps = 100000, kEvery = 37;  // out of step with the period
  const double dt = kOmegaDt / kOmega;
  Rig rig(api, breathing(api, PLEAT_INTEGRATOR_SYMPLECTIC_EULER, kAmplitude));
  SpringNet net = breathing_net(kAmplitude);
  const double start = net.energy();
  std::vector<double> step, energy;
  double swing = 0.0;
  for (int i = 0; i < kSteps; i += kEvery) {
    rig.step(dt, kEvery);
    for (uint32_t k = 0; k < 3; ++k) net.position[k] = rig.position(k), net.velocity[k] = rig.velocity(k);
    step.push_back(i);
    energy.push_back(net.energy() / start);
    swing = std::max(swing, std::abs(energy.back() - 1.0));
  }
  const double trend = fit_line(step, energy).slope * kSteps;
  // The scheme keeps a neighbouring energy, off by about omega dt / 2. Its rounding is a random walk of 1e5 steps.
  return {absolute("largest deviation in 1e5 steps", 0.0, swing, kOmegaDt),
          absolute("trend over 1e5 steps", 0.0, trend, 2e-3)};
}

}  // namespace pleat::bench
