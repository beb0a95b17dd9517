#include "systems/elastic_force.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kEndless = 1e30f;  // room for any stiffness

ElasticForce job(Sheet& sheet, float stiffness = 30.0f, float room = kEndless) {
  return {.garment = &sheet.garment,
          .position = sheet.position,
          .inverse_mass = sheet.inverse_mass,
          .law = {stiffness},
          .room = room,
          .force = sheet.force};
}

/// Corners 0 and 1 lie 2 m apart; 2 is moved so that its edges stay as they are at rest.
Sheet single_face() { return Sheet({{{0, 0, 0}, {2, 0, 0}, {1, 0, -1}}, {{0, 1, 2}}}); }

/// Energy of eq (1) at length l, in double.
double energy(double k, double rest, double l) { return k * (l * l * l / (3 * rest) - l * l / 2 + rest * rest / 6); }

double total_energy(const Sheet& sheet, double k) {
  double sum = 0.0;
  for (std::uint32_t e = 0; e < sheet.garment.edge_count; ++e) {
    const Vec3d d = wide(sheet.position[sheet.garment.edge_particle[1][e]]) -
                    wide(sheet.position[sheet.garment.edge_particle[0][e]]);
    sum += energy(k, sheet.garment.edge_rest_length[e], length(d));
  }
  return sum;
}

TEST(ElasticForce, RefusesToRunWithAFieldMissing) {
  Sheet sheet = single_face();
  const ElasticForce good = job(sheet);
  ASSERT_TRUE(good.validate());
  ElasticForce bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
  for (const float value : {-1.0f, kNan}) {
    bad = good, bad.law.stiffness = value;
    EXPECT_FALSE(bad.validate());
  }
  for (const float value : {0.0f, -1.0f, kNan}) {
    bad = good, bad.room = value;
    EXPECT_FALSE(bad.validate());
  }
}

TEST(ElasticForce, IsEquationOneInSizeAndDirection) {
  for (const float stretch : {0.25f, 0.5f, 0.9f, 1.0f, 1.1f, 3.0f}) {
    Sheet sheet = single_face();
    // Stretching the whole face stretches all edges alike: the forces at corner 0 are k (s - 1) times its edges.
    for (std::uint32_t i = 0; i < 3; ++i) sheet.position.set(i, sheet.position[i] * stretch);
    job(sheet).run();
    const Vec3 expected = (Vec3{2, 0, 0} + Vec3{1, 0, -1}) * (stretch * 30.0f * (stretch - 1.0f));
    EXPECT_NEAR(length(sheet.force[0] - expected), 0.0f, 1e-5f * (1.0f + length(expected))) << stretch;
  }
}

TEST(ElasticForce, IsMinusTheGradientOfItsEnergy) {
  Sheet sheet(make_grid({.rows = 3, .columns = 3}));
  shake(sheet.position, sheet.count, 0.15f, 1);
  job(sheet).run();
  constexpr float h = 1.0f / 4096;
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    const Vec3 x = sheet.position[i];
    const auto slope = [&](const Vec3& step) {
      sheet.position.set(i, x + step);
      const Vec3d ahead = wide(sheet.position[i]);
      const double up = total_energy(sheet, 30.0);
      sheet.position.set(i, x - step);
      const double along = length(ahead - wide(sheet.position[i]));
      const double down = total_energy(sheet, 30.0);
      sheet.position.set(i, x);
      return (up - down) / along;
    };
    EXPECT_NEAR(sheet.force[i].x, -slope({h, 0, 0}), 2e-5);
    EXPECT_NEAR(sheet.force[i].y, -slope({0, h, 0}), 2e-5);
    EXPECT_NEAR(sheet.force[i].z, -slope({0, 0, h}), 2e-5);
  }
}

TEST(ElasticForce, TangentStiffnessIsKAtRestAndZeroAtHalfLength) {
  const auto force_at = [](float l) {  // of edge 0-1 alone: corner 2 is kept on the middle line at its rest distances
    Sheet sheet = single_face();
    const float half = 0.5f * l, side = std::sqrt(2.0f);
    sheet.position.set(1, {l, 0, 0});
    sheet.position.set(2, {half, 0, -std::sqrt(side * side - half * half)});
    job(sheet).run();
    return sheet.force[0].x;
  };
  // F(l) is a parabola: central differences are exact.
  EXPECT_NEAR((force_at(2.01f) - force_at(1.99f)) / 0.02f, 30.0f, 0.05f);
  EXPECT_NEAR((force_at(1.01f) - force_at(0.99f)) / 0.02f, 0.0f, 0.05f);
  EXPECT_NEAR((force_at(2.21f) - force_at(2.19f)) / 0.02f, 36.0f, 0.05f);
}

TEST(ElasticForce, PastItsBucklingRisesATenthAsFastFromTheSameForce) {
  const auto force_at = [](float stretch) {
    Sheet sheet = single_face();
    for (std::uint32_t i = 0; i < 3; ++i) sheet.position.set(i, sheet.position[i] * stretch);
    ElasticForce bent = job(sheet);
    bent.law.buckling = 0.25f;
    bent.run();
    return sheet.force[0].x / (3.0f * stretch);  // over the edges' sum: k (s - 1)
  };
  EXPECT_FLOAT_EQ(force_at(1.5f), 15.0f);
  EXPECT_FLOAT_EQ(force_at(0.75f), -7.5f);
  EXPECT_NEAR(force_at(0.7499f), -7.5f, 1e-3f);
  EXPECT_FLOAT_EQ(force_at(0.5f), -7.5f - 0.75f);
}

TEST(ElasticForce, KeepsMomentum) {
  Sheet sheet(make_grid({.rows = 6, .columns = 6}));
  shake(sheet.position, sheet.count, 0.2f, 2);
  job(sheet).run();
  const Totals sum = totals(sheet.position, sheet.force, sheet.count);
  EXPECT_LT(length(sum.force), 1e-6 * sum.size);
  EXPECT_LT(length(sum.torque), 1e-6 * sum.size);
}

TEST(ElasticForce, IsAddedToWhatIsThere) {
  Sheet sheet = single_face();
  for (std::uint32_t i = 0; i < 3; ++i) sheet.force.set(i, {1, 2, 3});
  job(sheet).run();
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_NEAR(length(sheet.force[i] - Vec3{1, 2, 3}), 0.0f, 1e-5f);
}

TEST(ElasticForce, IsSoftenedToWhatAStepCanCarry) {
  Sheet sheet = single_face();
  for (std::uint32_t i = 0; i < 3; ++i) sheet.position.set(i, sheet.position[i] * 1.5f);
  constexpr float kRoom = 1e4f;
  job(sheet, 1e9f, kRoom).run();
  const float softened = kRoom / (2.0f * 2.0f * sheet.inverse_mass[0]);  // two edges at each corner
  const Vec3 expected = (Vec3{3, 0, 0} + Vec3{1.5f, 0, -1.5f}) * (0.5f * softened);
  EXPECT_NEAR(length(sheet.force[0] - expected), 0.0f, 1e-5f * length(expected));
}

TEST(ElasticForce, KeepsSymplecticStepsBoundedAtAnyStiffness) {
  Sheet sheet(make_grid({.rows = 8, .columns = 8}));
  shake(sheet.position, sheet.count, 1e-3f, 3);
  const float dt = 1.0f / 60;
  for (int step = 0; step < 2000; ++step) {
    sheet.clear_force();
    job(sheet, 1e9f, 2.56f / (dt * dt)).run();
    for (std::uint32_t i = 0; i < sheet.count; ++i) {
      sheet.velocity.add(i, sheet.force[i] * (dt * sheet.inverse_mass[i]));
      sheet.position.add(i, sheet.velocity[i] * dt);
    }
  }
  for (std::uint32_t e = 0; e < sheet.garment.edge_count; ++e) {
    const Vec3 d =
        sheet.position[sheet.garment.edge_particle[1][e]] - sheet.position[sheet.garment.edge_particle[0][e]];
    EXPECT_NEAR(length(d) / sheet.garment.edge_rest_length[e], 1.0f, 0.05f) << e;
  }
}

TEST(ElasticForce, CollapsedEdgesGiveNoForce) {
  Sheet sheet = single_face();
  for (std::uint32_t i = 0; i < 3; ++i) sheet.position.set(i, {1, 1, 1});
  job(sheet).run();
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(sheet.force[i], Vec3{});
}

}  // namespace
}  // namespace pleat
