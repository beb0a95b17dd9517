#include "systems/hinge_bending.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kStiffness = 5e-5f, kShortDt = 1e-4f;

HingeBending job(Sheet& sheet, float stiffness = kStiffness, float damping_rate = 0.0f, float dt = kShortDt) {
  return {.garment = &sheet.garment,
          .position = sheet.position,
          .velocity = sheet.velocity,
          .inverse_mass = sheet.inverse_mass,
          .stiffness = stiffness,
          .damping_rate = damping_rate,
          .dt = dt,
          .packed = &sheet.packed,
          .scratch = &sheet.hinge_scratch,
          .force = sheet.force};
}

/// Two faces at the edge 0-1, at rest at `angle` to each other.
Sheet hinge(float angle = 0.0f) {
  return Sheet({{{0, 0, 0}, {1, 0, 0}, {0.4f, 0, -0.9f}, {0.6f, 0.8f * std::sin(angle), 0.8f * std::cos(angle)}},
                {{0, 1, 2}, {1, 0, 3}}});
}

double angle_of(const Sheet& sheet, std::uint32_t h) {
  Vec3d x[4];
  for (std::size_t k = 0; k < 4; ++k) x[k] = wide(sheet.position[sheet.garment.hinge_particle[k][h]]);
  const Vec3d e = x[1] - x[0], na = cross(e, x[2] - x[0]), nb = cross(x[3] - x[0], e);
  return std::atan2(dot(cross(na, nb), e) / length(e), dot(na, nb));
}

double energy(const Sheet& sheet) {
  const Garment& g = sheet.garment;
  std::vector<double> turn(g.hinge_count);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    turn[h] = std::remainder(angle_of(sheet, h) - static_cast<double>(g.hinge_rest_angle[h]), 2.0 * std::numbers::pi);
  }
  double sum = 0.0;
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    double moment = static_cast<double>(g.hinge_shape[h]) * turn[h];
    for (std::size_t k = 0; k < 4; ++k) {
      moment += static_cast<double>(g.hinge_coupling[k][h]) * turn[g.hinge_beside[k][h]];
    }
    sum += 0.5 * static_cast<double>(kStiffness) * moment * turn[h];
  }
  return sum;
}

void expect_force_is_minus_gradient(Sheet& sheet) {
  job(sheet).run();
  constexpr float h = 1.0f / 4096;
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    const Vec3 x = sheet.position[i], f = sheet.force[i];
    const auto slope = [&](const Vec3& step) {
      sheet.position.set(i, x + step);
      const Vec3d ahead = wide(sheet.position[i]);
      const double up = energy(sheet);
      sheet.position.set(i, x - step);
      const double along = length(ahead - wide(sheet.position[i]));
      const double down = energy(sheet);
      sheet.position.set(i, x);
      return (up - down) / along;
    };
    const double tolerance = 2e-4 * length(wide(f)) + 1e-9;
    EXPECT_NEAR(f.x, -slope({h, 0, 0}), tolerance);
    EXPECT_NEAR(f.y, -slope({0, h, 0}), tolerance);
    EXPECT_NEAR(f.z, -slope({0, 0, h}), tolerance);
  }
}

TEST(HingeBending, RefusesToRunWithAFieldMissing) {
  Sheet sheet = hinge();
  const HingeBending good = job(sheet);
  ASSERT_TRUE(good.validate());
  HingeBending bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.scratch = nullptr;
  EXPECT_FALSE(bad.validate());
  HingeScratch small(std::pmr::new_delete_resource());
  bad = good, bad.scratch = &small;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
  for (const float value : {-1.0f, kNan}) {
    bad = good, bad.stiffness = value;
    EXPECT_FALSE(bad.validate());
    bad = good, bad.damping_rate = value;
    EXPECT_FALSE(bad.validate());
  }
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(HingeBending, IsMinusTheGradientOfItsEnergy) {
  for (const float rest : {0.0f, 0.7f, -2.0f}) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      Sheet sheet = hinge(rest);
      shake(sheet.position, sheet.count, 0.2f, seed);
      expect_force_is_minus_gradient(sheet);
    }
  }
}

TEST(HingeBending, IsMinusTheGradientOnASheetOfManyHinges) {
  Sheet sheet(make_grid({.rows = 4, .columns = 4, .width = 3.0f, .depth = 3.0f}));
  shake(sheet.position, sheet.count, 0.2f, 9);
  expect_force_is_minus_gradient(sheet);
}

TEST(HingeBending, RestsWithoutForceFlatOrBent) {
  for (const float rest : {0.0f, 1.0f, -2.5f}) {
    Sheet sheet = hinge(rest);
    job(sheet, 1.0f).run();
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_LT(length(sheet.force[i]), 2e-6f);
  }
}

TEST(HingeBending, TakesTheShortWayRound) {
  Sheet sheet = hinge(3.0f);
  sheet.position.set(3, {0.6f, 0.8f * std::sin(-3.0f), 0.8f * std::cos(-3.0f)});
  job(sheet, 1.0f).run();
  // From 3 rad to -3 rad it is 0.28 rad past the full fold, not 6 rad back.
  Sheet same = hinge(0.0f);
  const float turn = 2.0f * std::numbers::pi_v<float> - 6.0f;
  same.position.set(3, {0.6f, 0.8f * std::sin(turn), 0.8f * std::cos(turn)});
  job(same, 1.0f).run();
  EXPECT_NEAR(length(sheet.force[3]), length(same.force[3]), 1e-4f * length(same.force[3]));
}

TEST(HingeBending, KeepsMomentum) {
  Sheet sheet(make_grid({.rows = 6, .columns = 6}));
  shake(sheet.position, sheet.count, 0.08f, 2);
  shake(sheet.velocity, sheet.count, 1.0f, 3);
  job(sheet, 1e-3f, 4.0f).run();
  const Totals sum = totals(sheet.position, sheet.force, sheet.count);
  EXPECT_GT(sum.size, 1e-3);
  EXPECT_LT(length(sum.force), 2e-6 * sum.size);
  EXPECT_LT(length(sum.torque), 2e-6 * sum.size);
}

TEST(HingeBending, DampingTakesEnergyAndNeverReverses) {
  for (const float rate : {4.0f, 1e6f}) {
    Sheet sheet = hinge();
    const float dt = 1.0f / 60;
    sheet.velocity.set(3, {0, 1, 0});
    const double before = angle_of(sheet, 0);
    job(sheet, 0.0f, rate, dt).run();
    const auto turning = [&] {  // rate of the angle, by a small step
      Sheet later = hinge();
      for (std::uint32_t i = 0; i < 4; ++i) later.position.add(i, sheet.velocity[i] * 1e-3f);
      return (angle_of(later, 0) - before) / 1e-3;
    };
    const double was = turning();
    double power = 0.0;
    for (std::uint32_t i = 0; i < 4; ++i) power += dot(wide(sheet.force[i]), wide(sheet.velocity[i]));
    EXPECT_LT(power, 0.0);
    for (std::uint32_t i = 0; i < 4; ++i) sheet.velocity.add(i, sheet.force[i] * (dt * sheet.inverse_mass[i]));
    EXPECT_NEAR(turning() / was, 1.0 - static_cast<double>(std::min(rate * dt, 0.2f)), 1e-3);
  }
}

TEST(HingeBending, StiffStepsAreDampedAtLeastAsBackwardEulerWould) {
  const float dt = 1e-3f;
  const auto power = [&](float rate, float step_damping) {  // of damping alone: the hinge is where it rests
    Sheet sheet = hinge();
    sheet.velocity.set(3, {0, 1, 0});
    HingeBending bending = job(sheet, kStiffness, rate, dt);
    bending.step_damping = step_damping;
    bending.run();
    return dot(wide(sheet.force[3]), wide(sheet.velocity[3]));
  };
  EXPECT_EQ(power(0.0f, 0.0f), 0.0);
  // Backward Euler's force after a step is that of the angle it has turned by then: K v dt.
  Sheet turned = hinge();
  turned.position.add(3, {0, dt, 0});
  job(turned, kStiffness, 0.0f, dt).run();
  EXPECT_NEAR(power(0.0f, 1.0f) / static_cast<double>(turned.force[3].y), 1.0, 1e-3);
  EXPECT_NEAR(power(0.0f, 0.5f) / power(0.0f, 1.0f), 0.5, 1e-5);
  EXPECT_EQ(power(4.0f, 0.5f), power(4.0f, 0.0f));  // the larger of the two counts
}

TEST(HingeBending, IsSoftenedToWhatAStepCanCarry) {
  Sheet stiff = hinge(), stiffer = hinge();
  for (Sheet* sheet : {&stiff, &stiffer}) sheet->position.add(3, {0, 0.3f, 0});
  job(stiff, 1e6f, 0.0f, 1.0f / 60).run();
  job(stiffer, 1e9f, 0.0f, 1.0f / 60).run();
  // The softness is a root, rounded twice.
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_LT(length(stiff.force[i] - stiffer.force[i]), 1e-6f * length(stiff.force[i]));
  }
  EXPECT_GT(length(stiff.force[3]), 0.0f);
}

TEST(HingeBending, TheStiffestStepTakesAHingeAFifthOfTheWayToRest) {
  const float dt = 1.0f / 60;
  Sheet sheet = hinge();
  sheet.position.add(3, {0, 1e-3f, 0});
  const double before = angle_of(sheet, 0);
  job(sheet, 1e6f, 0.0f, dt).run();
  for (std::uint32_t i = 0; i < 4; ++i) sheet.position.add(i, sheet.force[i] * (dt * dt * sheet.inverse_mass[i]));
  EXPECT_NEAR(angle_of(sheet, 0) / before, 0.8, 1e-3);
}

TEST(HingeBending, FaceWithoutAreaIsPassedOver) {
  Sheet sheet = hinge();
  sheet.position.set(3, sheet.position[0]);
  job(sheet, 1.0f, 4.0f).run();
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(sheet.force[i], Vec3{});
}

TEST(HingeBending, AFaceThatHasAllButVanishedIsPassedOver) {
  for (const float size : {1e-8f, 1e-11f, 1e-14f, 1e-20f, 1e-30f}) {
    Sheet sheet = hinge();
    for (std::uint32_t i = 0; i < 4; ++i) sheet.position.set(i, sheet.position[i] * size);
    shake(sheet.velocity, sheet.count, 2.0f, 1);
    job(sheet, 1.0f, 4.0f).run();
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(sheet.force[i], Vec3{}) << size;
  }
}

TEST(HingeBending, PropertyEveryVectorSetGivesTheSameBits) {
  for (std::uint32_t n = 2; n < 12; ++n) {  // blocks that are full, and the rest of one
    const Mesh mesh = make_grid({.rows = n, .columns = n});
    std::vector<Vec3> expected;
    for (const VectorSet set : kVectorSets) {
      if (set > widest_vectors()) continue;
      Sheet sheet(mesh);
      shake(sheet.position, sheet.count, 0.4f, n);
      shake(sheet.velocity, sheet.count, 2.0f, n + 100);
      sheet.position.set(0, sheet.position[1]);  // and a face without area
      job(sheet, 1e-3f, 4.0f).run(set);
      for (std::uint32_t i = 0; i < sheet.count; ++i) {
        if (set == VectorSet::kBaseline) expected.push_back(sheet.force[i]);
        EXPECT_EQ(sheet.force[i], expected[i]) << n << ", particle " << i;
      }
    }
  }
}

}  // namespace
}  // namespace pleat
