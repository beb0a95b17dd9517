#include "systems/integration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

enum class Scheme { kExplicit, kSymplectic, kRungeKutta };

/// One particle of 1 kg with its columns, under any force law.
struct Particle {
  float inverse_mass = 1.0f;
  Vec3 x, v, f, start_x, start_v, slope_x, slope_v;

  Column<float> inverse_masses{std::pmr::new_delete_resource()};  // of whole lanes, as Euler's steps read and write
  Vec3Column force{std::pmr::new_delete_resource()}, position{std::pmr::new_delete_resource()},
      velocity{std::pmr::new_delete_resource()};

  static Vec3View view(Vec3& a) { return {&a.x, &a.y, &a.z}; }

  EulerIntegration euler(float dt, bool symplectic) {
    inverse_masses.resize(1);
    for (Vec3Column* column : {&force, &position, &velocity}) column->resize(1);
    inverse_masses[0] = inverse_mass;
    force.view().set(0, f), position.view().set(0, x), velocity.view().set(0, v);
    return {.particle_count = 1,
            .inverse_mass = inverse_masses.data(),
            .force = force.view(),
            .dt = dt,
            .symplectic = symplectic,
            .position = position.view(),
            .velocity = velocity.view()};
  }
  RungeKuttaIntegration runge_kutta(float dt, int stage) {
    return {.particle_count = 1,
            .inverse_mass = &inverse_mass,
            .force = view(f),
            .start_position = view(start_x),
            .dt = dt,
            .stage = stage,
            .position = view(x),
            .velocity = view(v),
            .start_velocity = view(start_v),
            .position_slope = view(slope_x),
            .velocity_slope = view(slope_v)};
  }
  void step(Scheme scheme, float dt, const std::function<Vec3(const Vec3&, const Vec3&)>& law) {
    if (scheme == Scheme::kRungeKutta) {
      start_x = x;
      for (int stage = 0; stage < 4; ++stage) {
        f = law(x, v);
        runge_kutta(dt, stage).run();
      }
    } else {
      f = law(x, v);
      euler(dt, scheme == Scheme::kSymplectic).run();
      x = position.view()[0], v = velocity.view()[0];
    }
  }
};

TEST(Integration, RefusesToRunWithAFieldMissing) {
  Particle p;
  const EulerIntegration euler = p.euler(0.1f, true);
  ASSERT_TRUE(euler.validate());
  EulerIntegration bad = euler;
  bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = euler, bad.force = {};
  EXPECT_FALSE(bad.validate());
  bad = euler, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = euler, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = euler, bad.dt = kNan;
  EXPECT_FALSE(bad.validate());

  const RungeKuttaIntegration good = p.runge_kutta(0.1f, 0);
  ASSERT_TRUE(good.validate());
  using Job = RungeKuttaIntegration;
  for (ConstVec3View Job::*field : {&Job::force, &Job::start_position}) {
    Job broken = good;
    broken.*field = {};
    EXPECT_FALSE(broken.validate());
  }
  for (Vec3View Job::*field :
       {&Job::position, &Job::velocity, &Job::start_velocity, &Job::position_slope, &Job::velocity_slope}) {
    Job broken = good;
    broken.*field = {};
    EXPECT_FALSE(broken.validate());
  }
  Job broken = good;
  broken.inverse_mass = nullptr;
  EXPECT_FALSE(broken.validate());
  broken = good, broken.dt = 0.0f;
  EXPECT_FALSE(broken.validate());
  for (const int stage : {-1, 4}) {
    broken = good, broken.stage = stage;
    EXPECT_FALSE(broken.validate());
  }
}

TEST(Integration, FreeFallHasExactlyTheErrorOfItsScheme) {
  // g = -8 and dt = 1/64 make every sum exact in float.
  constexpr float g = -8.0f, dt = 1.0f / 64;
  const auto fall = [](const Vec3&, const Vec3&) { return Vec3{0, g, 0}; };
  Particle explicit_euler, symplectic, runge_kutta;
  for (int i = 1; i <= 64; ++i) {
    explicit_euler.step(Scheme::kExplicit, dt, fall);
    symplectic.step(Scheme::kSymplectic, dt, fall);
    runge_kutta.step(Scheme::kRungeKutta, dt, fall);
    const float t = static_cast<float>(i) * dt, exact = 0.5f * g * t * t;
    EXPECT_EQ(symplectic.x.y - exact, 0.5f * g * t * dt);
    EXPECT_EQ(explicit_euler.x.y - exact, -0.5f * g * t * dt);
    EXPECT_NEAR(runge_kutta.x.y, exact, 2e-6f);
    EXPECT_EQ(symplectic.v.y, g * t);
    EXPECT_EQ(explicit_euler.v.y, g * t);
    EXPECT_NEAR(runge_kutta.v.y, g * t, 4e-6f);
  }
}

double oscillator_error(Scheme scheme, int steps) {
  constexpr double time = 3.0;
  Particle p;
  p.x = {1, 0, 0};
  for (int i = 0; i < steps; ++i) {
    p.step(scheme, static_cast<float>(time / steps), [](const Vec3& x, const Vec3&) { return -x; });
  }
  return std::hypot(static_cast<double>(p.x.x) - std::cos(time), static_cast<double>(p.v.x) + std::sin(time));
}

double order(Scheme scheme, int steps) {
  return std::log2(oscillator_error(scheme, steps) / oscillator_error(scheme, 2 * steps));
}

TEST(Integration, OscillatorShowsTheOrderOfEachScheme) {
  EXPECT_NEAR(order(Scheme::kExplicit, 200), 1.0, 0.1);
  EXPECT_NEAR(order(Scheme::kSymplectic, 200), 1.0, 0.1);
  EXPECT_NEAR(order(Scheme::kRungeKutta, 12), 4.0, 0.1);
}

TEST(Integration, SymplecticKeepsTheOscillatorsEnergyBounded) {
  Particle p;
  p.x = {1, 0, 0};
  for (int i = 0; i < 100000; ++i) p.step(Scheme::kSymplectic, 0.2f, [](const Vec3& x, const Vec3&) { return -x; });
  const float energy = dot(p.x, p.x) + dot(p.v, p.v) - 0.2f * dot(p.x, p.v);  // the conserved one, at the start 1
  EXPECT_NEAR(energy, 1.0f, 1e-2f);
}

TEST(Integration, PinsGoStraightWhateverTheForce) {
  for (const Scheme scheme : {Scheme::kExplicit, Scheme::kSymplectic, Scheme::kRungeKutta}) {
    Particle p;
    p.inverse_mass = 0.0f;
    p.v = {1, 2, 3};
    p.step(scheme, 0.5f, [](const Vec3&, const Vec3&) { return Vec3{1e6f, 0, 0}; });
    EXPECT_NEAR(length(p.x - Vec3{0.5f, 1.0f, 1.5f}), 0.0f, 1e-6f);
    EXPECT_NEAR(length(p.v - Vec3{1, 2, 3}), 0.0f, 1e-6f);
  }
}

}  // namespace
}  // namespace pleat
