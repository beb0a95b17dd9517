#include "systems/implicit_solver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "systems/elastic_force.h"
#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr std::uint32_t kPins[] = {0, 3};

Sheet shaken_sheet() {
  Sheet sheet(make_grid({.rows = 4, .columns = 4}), kPins);
  shake(sheet.position, sheet.count, 0.05f, 5);
  shake(sheet.velocity, sheet.count, 1.0f, 6);
  return sheet;
}

void add_springs(Sheet& s, float k) { ElasticForce{&s.garment, s.position, s.inverse_mass, {k}, 1e30f, s.force}.run(); }

ImplicitIntegration job(Sheet& s, ImplicitMatrix& matrix, float stiffness, float dt) {
  return {.garment = &s.garment,
          .matrix = &matrix,
          .inverse_mass = s.inverse_mass,
          .force = s.force,
          .law = {stiffness},
          .dt = dt,
          .position = s.position,
          .velocity = s.velocity};
}

TEST(ImplicitIntegration, RefusesToRunWithAFieldMissing) {
  Sheet sheet = shaken_sheet();
  ImplicitMatrix matrix(sheet.garment);
  const ImplicitIntegration good = job(sheet, matrix, 30.0f, 0.01f);
  ASSERT_TRUE(good.validate());
  ImplicitIntegration bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.matrix = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.law.stiffness = kNan;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(ImplicitIntegration, SolvesTheLinearisedEquation) {
  constexpr float kStiffness = 500.0f, kDt = 0.02f;
  Sheet sheet = shaken_sheet();
  ImplicitMatrix matrix(sheet.garment);
  add_springs(sheet, kStiffness);
  std::vector<Vec3d> x, v, f;
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    x.push_back(wide(sheet.position[i])), v.push_back(wide(sheet.velocity[i])), f.push_back(wide(sheet.force[i]));
  }
  job(sheet, matrix, kStiffness, kDt).run();
  // M (v' - v) = dt (F - dt K v'), row by row.
  std::vector<Vec3d> residual(sheet.count);
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    residual[i] = (wide(sheet.velocity[i]) - v[i]) * double(sheet.mass[i]) - f[i] * double(kDt);
  }
  const Garment& g = sheet.garment;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    const Vec3d d = x[j] - x[i], w = wide(sheet.velocity[j]) - wide(sheet.velocity[i]);
    const double l = length(d), rest = g.edge_rest_length[e];
    const Vec3d pull =
        (w * std::max(l / rest - 1.0, 0.0) + d * (dot(d, w) / (l * rest))) * double(kStiffness * kDt * kDt);
    residual[i] -= pull;
    residual[j] += pull;
  }
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    if (g.pinned[i]) {
      EXPECT_EQ(wide(sheet.velocity[i]), v[i]);
    } else {
      EXPECT_NEAR(length(residual[i]), 0.0, 2e-7) << i;  // kg m/s; the parts are up to 0.1
    }
    EXPECT_NEAR(length(wide(sheet.position[i]) - x[i] - wide(sheet.velocity[i]) * double(kDt)), 0.0, 1e-6);
  }
}

TEST(ImplicitIntegration, FallsAsAnyOther) {
  Sheet sheet(make_grid({.rows = 4, .columns = 4}));
  ImplicitMatrix matrix(sheet.garment);
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.force.set(i, Vec3{0, -9.81f, 0} * sheet.mass[i]);
  job(sheet, matrix, 1e4f, 0.1f).run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_NEAR(sheet.velocity[i].y, -0.981f, 1e-5f);
}

TEST(ImplicitIntegrationProperty, CalmsAnyStiffnessInAnyStep) {
  for (const float stiffness : {1.0f, 1e4f, 1e9f}) {
    for (const float dt : {0.001f, 0.1f}) {
      Sheet sheet = shaken_sheet();
      for (const std::uint32_t pin : kPins) sheet.velocity.set(pin, {});
      ImplicitMatrix matrix(sheet.garment);
      for (int i = 0; i < 200; ++i) {
        sheet.clear_force();
        add_springs(sheet, stiffness);
        job(sheet, matrix, stiffness, dt).run();
        // No farther in a step than the sheet is long, where an explicit one of 1e9 N/m would be gone at once.
        for (std::uint32_t k = 0; k < sheet.count; ++k)
          ASSERT_LT(length(sheet.velocity[k]), 1.0f / dt) << stiffness << ' ' << dt;
      }
    }
  }
}

}  // namespace
}  // namespace pleat
