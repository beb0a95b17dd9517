#include "systems/frequency_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "systems/elastic_force.h"
#include "systems/hinge_bending.h"
#include "systems/integration.h"
#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kEndless = 1e30f;  // room for any stiffness

FrequencyRates rates_of(const Sheet& s) { return FrequencyBound{&s.garment, s.inverse_mass}.run(); }

void add_springs(Sheet& s, float k) {
  ElasticForce{&s.garment, s.position, s.inverse_mass, {k}, kEndless, s.force}.run();
}
void add_hinges(Sheet& s, float b) {
  HingeBending{&s.garment, s.position, s.velocity, s.inverse_mass, b, 0.0f, 1e-6f, &s.packed, &s.hinge_scratch, s.force}
      .run();
}

/// The largest eigenvalue of -M^-1 dF/dx at rest, by power iteration on small displacements.
template <class AddForces>
double largest_omega2(Sheet& s, const AddForces& add_forces) {
  std::vector<Vec3> rest(s.count), u(s.count);
  for (std::uint32_t i = 0; i < s.count; ++i) rest[i] = s.position[i];
  shake(s.velocity, s.count, 1.0f, 7);
  for (std::uint32_t i = 0; i < s.count; ++i) u[i] = s.velocity[i], s.velocity.set(i, {});
  double eigenvalue = 0.0;
  for (int iteration = 0; iteration < 300; ++iteration) {
    double norm = 0.0;
    for (std::uint32_t i = 0; i < s.count; ++i) {
      if (s.inverse_mass[i] > 0.0f) norm += static_cast<double>(dot(u[i], u[i]) / s.inverse_mass[i]);
    }
    const float scale = static_cast<float>(1.0 / std::sqrt(norm));
    constexpr float kStep = 2e-6f;
    for (std::uint32_t i = 0; i < s.count; ++i) {
      u[i] = s.inverse_mass[i] > 0.0f ? u[i] * scale : Vec3{};
      s.position.set(i, rest[i] + u[i] * kStep);
    }
    s.clear_force();
    add_forces();
    eigenvalue = 0.0;
    for (std::uint32_t i = 0; i < s.count; ++i) {
      const Vec3 v = s.force[i] * (-s.inverse_mass[i] / kStep);
      if (s.inverse_mass[i] > 0.0f) eigenvalue += static_cast<double>(dot(v, u[i]) / s.inverse_mass[i]);
      u[i] = v;
    }
  }
  for (std::uint32_t i = 0; i < s.count; ++i) s.position.set(i, rest[i]);
  return eigenvalue;
}

/// A sheet with a pinned corner, uneven triangles and a hem `heavy` times as heavy.
Sheet uneven_sheet(float heavy) {
  Mesh mesh = make_grid({.rows = 7, .columns = 7});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const float k = static_cast<float>(i);
    mesh.positions[i] += {0.03f * std::sin(7.0f * k), 0.0f, 0.03f * std::cos(5.0f * k)};
  }
  static constexpr std::uint32_t kPins[] = {0};
  Sheet sheet(mesh, kPins);
  for (std::uint32_t i = 42; i < 49; ++i) sheet.inverse_mass[i] /= heavy;
  return sheet;
}

TEST(FrequencyBound, RefusesToRunWithAFieldMissing) {
  Sheet sheet = uneven_sheet(1.0f);
  EXPECT_TRUE((FrequencyBound{&sheet.garment, sheet.inverse_mass}.validate()));
  EXPECT_FALSE((FrequencyBound{nullptr, sheet.inverse_mass}.validate()));
  EXPECT_FALSE((FrequencyBound{&sheet.garment, nullptr}.validate()));
  EXPECT_TRUE(StableStep{}.validate());
  EXPECT_FALSE((StableStep{.rates = {}, .stiffness = kNan}.validate()));
  EXPECT_FALSE((StableStep{.rates = {}, .bend_stiffness = -1.0f}.validate()));
}

TEST(FrequencyBound, OfASingleFaceIsTwiceItsEdgesOverItsMass) {
  Sheet face({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -0.8660254f}}, {{0, 1, 2}}});
  const float w = face.inverse_mass[0];
  const FrequencyRates rates = rates_of(face);
  EXPECT_NEAR(rates.stretch, 4.0f * w, 1e-3f * w);
  EXPECT_NEAR(rates.edge_damping, 2.0f, 1e-3f);  // of 1 / (w_i + w_j) at each of two edges
  EXPECT_EQ(rates.bend, 0.0f);
}

TEST(FrequencyBoundProperty, IsAboveTheHighestFrequencyAndNotFarAbove) {
  for (const float heavy : {1.0f, 100.0f, 1e4f}) {
    Sheet sheet = uneven_sheet(heavy);
    const FrequencyRates rates = rates_of(sheet);
    const double springs = largest_omega2(sheet, [&] { add_springs(sheet, 30.0f); }) / 30.0;
    EXPECT_GT(rates.stretch, 0.99 * springs) << heavy;
    EXPECT_LT(rates.stretch, 4.0 * springs) << heavy;
    const double hinges = largest_omega2(sheet, [&] { add_hinges(sheet, 1e-2f); }) / 1e-2;
    EXPECT_GT(rates.bend, 0.99 * hinges) << heavy;
    EXPECT_LT(rates.bend, 4.0 * hinges) << heavy;
  }
}

/// Largest elongation after `steps` of symplectic Euler.
float strain_after(float dt, float room, int steps) {
  Sheet sheet = uneven_sheet(100.0f);
  shake(sheet.position, sheet.count, 1e-3f, 3);
  for (int i = 0; i < steps; ++i) {
    sheet.clear_force();
    ElasticForce{&sheet.garment, sheet.position, sheet.inverse_mass, {1e5f}, room, sheet.force}.run();
    EulerIntegration{sheet.count, sheet.inverse_mass, sheet.force, dt, true, sheet.position, sheet.velocity}.run();
  }
  float most = 0.0f;
  for (std::uint32_t e = 0; e < sheet.garment.edge_count; ++e) {
    const Vec3 d =
        sheet.position[sheet.garment.edge_particle[1][e]] - sheet.position[sheet.garment.edge_particle[0][e]];
    const float strain = length(d) / sheet.garment.edge_rest_length[e] - 1.0f;
    most = strain < most ? most : strain;  // and NaN
  }
  return most;
}

TEST(StableStepProperty, IsStableAndThreeTimesAsLongIsNotUnlessSoftened) {
  const StableStep stable{.rates = rates_of(uneven_sheet(100.0f)), .stiffness = 1e5f};
  constexpr float kTick = 1.0f / 60;
  const std::uint32_t n = stable.run(kTick, 1, 100000);
  ASSERT_LT(n, 100000u);
  const float dt = kTick / static_cast<float>(n);
  EXPECT_LT(strain_after(dt, kEndless, 3000), 0.1f);
  EXPECT_FALSE(strain_after(3.0f * dt, kEndless, 3000) < 1.0f);
  EXPECT_LT(strain_after(3.0f * dt, stable.room(3.0f * dt), 3000), 0.1f);
}

TEST(StableStep, TakesMoreForStifferMoreDampedAndMoreBentCloth) {
  StableStep step{.rates = rates_of(uneven_sheet(1.0f)), .stiffness = 1e3f};
  constexpr float kTick = 1.0f / 60;
  const std::uint32_t n = step.run(kTick, 1, 100000);
  StableStep other = step;
  other.stiffness = 1e5f;
  EXPECT_NEAR(other.run(kTick, 1, 100000), 10.0 * n, 10.0);
  other = step, other.edge_damping = 100.0f;
  EXPECT_GT(other.run(kTick, 1, 100000), n);
  other = step, other.bend_stiffness = 1.0f;
  EXPECT_GT(other.run(kTick, 1, 100000), n);
  other = step, other.scheme = Scheme::kRungeKutta4;
  EXPECT_LT(other.run(kTick, 1, 100000), n);
  EXPECT_EQ(step.run(kTick, 1, n - 1), n);  // none is stable
  EXPECT_EQ(step.run(kTick, n + 5, n + 9), n + 5);
}

}  // namespace
}  // namespace pleat
