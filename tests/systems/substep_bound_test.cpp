#include "systems/substep_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kDt = 1.0f / 30, kRadius = 0.045f, kThickness = 0.005f;

/// A sheet of 1 m2 in the plane y = 0 and one capsule along z that goes from `from` to `to` in a tick.
struct Crossing {
  Sheet sheet{make_grid({.rows = 4, .columns = 4})};
  CapsuleColumns capsules{std::pmr::new_delete_resource()};
  CollisionBodies bodies{std::pmr::new_delete_resource()};

  Crossing(const Vec3& from, const Vec3& to) {
    for (Vec3Column* column : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
      column->resize(1);
    }
    for (Column<float>* column : {&capsules.radius, &capsules.taper, &capsules.thickness, &capsules.friction})
      column->resize(1);
    capsules.enabled.resize(1), capsules.groups.push_back(kFirstGroup);
    capsules.enabled[0] = 1;
    capsules.radius[0] = kRadius;
    const Vec3 half{0, 0, 0.3f};
    capsules.previous_a.view().set(0, from - half), capsules.previous_b.view().set(0, from + half);
    capsules.next_a.view().set(0, to - half), capsules.next_b.view().set(0, to + half);
    set_velocity({});
  }
  void set_velocity(const Vec3& v) {
    for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.velocity.set(i, v);
  }
  SubstepBound job() {
    bodies.update_capsules(capsules);
    return {.particle_count = sheet.count,
            .position = sheet.position,
            .velocity = sheet.velocity,
            .capsules = &capsules,
            .bodies = &bodies,
            .thickness = kThickness,
            .dt = kDt};
  }
};

float rounded(const SubstepBound& job) { return std::ceil(std::max(job.run(), 1.0f)); }

TEST(SubstepBound, RefusesToRunWithAFieldMissing) {
  Crossing c({0, 0.2f, 0}, {0, -0.2f, 0});
  const SubstepBound good = c.job();
  ASSERT_TRUE(good.validate());
  SubstepBound bad = good;
  bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.capsules = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.bodies = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(SubstepBound, HalfTheRadiusASubstep) {
  EXPECT_EQ(rounded(Crossing({0, 0.2f, 0}, {0, -0.19f, 0}).job()), 16);  // .39 m in steps of .025 m
  EXPECT_EQ(rounded(Crossing({0, 0.2f, 0}, {0, 0.2f, 0}).job()), 1);
}

TEST(SubstepBound, BodiesFarAwayDisabledOrCarryingTheClothAskForNothing) {
  EXPECT_EQ(rounded(Crossing({5, 0.2f, 0}, {5, -0.2f, 0}).job()), 1);
  Crossing disabled({0, 0.2f, 0}, {0, -0.2f, 0});
  disabled.capsules.enabled[0] = 0;
  EXPECT_EQ(rounded(disabled.job()), 1);
  Crossing carrying({0, 0.2f, 0}, {0, -0.2f, 0});
  carrying.set_velocity(Vec3{0, -0.4f, 0} * (1.0f / kDt));
  EXPECT_EQ(rounded(carrying.job()), 1);
}

TEST(SubstepBound, MovingClothCountsToo) {
  Crossing c({0, 0.1f, 0}, {0, 0.1f, 0});
  c.sheet.velocity.set(5, {0, 0.16f * 30.0f, 0});  // the mean of 16 particles moves .01 m, this one .15 m more
  EXPECT_EQ(rounded(c.job()), 7);                  // .16 m in steps of .025 m
}

TEST(SubstepBound, AnyMotionHasAnAnswer) {
  Crossing c({0, 0, 0}, {1e9f, 0, 0});
  c.capsules.radius[0] = 0.0f;
  SubstepBound job = c.job();
  job.thickness = 0.0f;
  EXPECT_EQ(job.run(), SubstepBound::kMost);
}

TEST(SubstepBound, AMeshAsFarAsItsFeaturesAreLookedFor) {
  Crossing c({0, 5, 0}, {0, 5, 0});
  MeshCollider ball(std::pmr::new_delete_resource());
  ball.previous.resize(1), ball.next.resize(1);
  const MeshCollider* const meshes[] = {&ball};
  SubstepBound job = c.job();
  job.meshes = meshes, job.mesh_count = 1;
  const auto go = [&](const Vec3& from, const Vec3& to) {
    ball.previous.view().set(0, from), ball.next.view().set(0, to);
    return rounded(job);
  };
  EXPECT_EQ(go({0, 0.2f, 0}, {0, -0.2f, 0}), 27);  // .4 m in steps of .015 m
  EXPECT_EQ(go({0, 0.2f, 0}, {0, 0.2f, 0}), 1);
  EXPECT_EQ(go({5, 0.2f, 0}, {5, -0.2f, 0}), 1);  // beside the cloth
  c.set_velocity({0, -12, 0});
  EXPECT_EQ(go({0, 0.2f, 0}, {0, -0.2f, 0}), 1);  // carries it along
  ball.enabled = false;
  c.set_velocity({});
  EXPECT_EQ(go({0, 0.2f, 0}, {0, -0.2f, 0}), 1);
}

TEST(SubstepBound, OfALimbOnlyWhatComesNear) {
  Crossing c({0, 0, 0}, {0, 0, 0});
  // From the cloth's edge at x = .5 m, where it is hinged, 2 m outwards: the far end swings by 1 m, what is over the
  // cloth or within a radius and half a way of it by less.
  c.capsules.previous_a.view().set(0, {0.5f, 0.02f, 0}), c.capsules.next_a.view().set(0, {0.5f, 0.02f, 0});
  c.capsules.previous_b.view().set(0, {2.5f, 0.02f, -0.1f}), c.capsules.next_b.view().set(0, {2.5f, 0.02f, 0.1f});
  const float ways = 0.2f * (kRadius + kThickness + 0.1f) / 2.0f;  // m, at the end of the part that counts
  EXPECT_NEAR(c.job().run(), ways / (0.5f * (kRadius + kThickness)), 0.02f);
  // Seen from afar it all counts.
  c.capsules.previous_b.view().set(0, {0.5f, 0.02f, -0.1f}), c.capsules.next_b.view().set(0, {0.5f, 0.02f, 0.1f});
  EXPECT_NEAR(c.job().run(), 0.2f / (0.5f * (kRadius + kThickness)), 1e-4f);
}

TEST(SubstepBound, PropertyWhatTheClippedPartAsksForIsNoLessThanWhatTouches) {
  // Whatever point of the limb is in the cloth's box at any time of the tick, its way is counted.
  std::mt19937 random(5);
  std::uniform_real_distribution<float> where(-1.0f, 1.0f);
  const auto point = [&] { return Vec3{where(random), where(random), where(random)}; };
  int touching = 0;
  for (int round = 0; round < 500; ++round) {
    Crossing c({}, {});
    const Vec3 a0 = point(), b0 = point() * 3.0f, a1 = a0 + point() * 0.2f, b1 = b0 + point();
    c.capsules.previous_a.view().set(0, a0), c.capsules.previous_b.view().set(0, b0);
    c.capsules.next_a.view().set(0, a1), c.capsules.next_b.view().set(0, b1);
    const Box cloth = box_of(c.sheet.position, c.sheet.count).grown(kRadius + kThickness);
    float longest = 0.0f;
    for (int i = 0; i <= 40; ++i) {
      const float s = static_cast<float>(i) / 40.0f;
      const Vec3 from = a0 + (b0 - a0) * s, to = a1 + (b1 - a1) * s;
      for (int k = 0; k <= 20; ++k) {
        if (cloth.distance2(from + (to - from) * (static_cast<float>(k) / 20.0f)) == 0.0f) {
          longest = std::max(longest, length(to - from));
        }
      }
    }
    touching += longest > 0.0f;
    EXPECT_GE(c.job().run() * 0.5f * (kRadius + kThickness), 0.9999f * longest) << round;
  }
  EXPECT_GT(touching, 100);
}

TEST(SubstepBound, AgainstClothThatIsCarriedOnlyWhatDoesNotGoAlong) {
  const float turn = 0.5f;  // rad about z, and a way
  const RigidMotion carry{{0, 0, 0}, {0.1f, 0, 0.2f}, {0, 0, std::sin(turn / 2), std::cos(turn / 2)}};
  Crossing c({0.2f, 0.02f, 0}, carry.apply({0.2f, 0.02f, 0}));
  for (auto* ends : {&c.capsules.previous_a, &c.capsules.previous_b}) {
    auto* next = ends == &c.capsules.previous_a ? &c.capsules.next_a : &c.capsules.next_b;
    next->view().set(0, carry.apply(ends->view()[0]));
  }
  c.set_velocity({7, 8, 9});  // which the cloth keeps for later
  SubstepBound job = c.job();
  job.carry = carry;
  EXPECT_NEAR(job.run(), 0.0f, 1e-4f);
  job.carry = RigidMotion{};
  EXPECT_NEAR(job.run(), length(c.capsules.next_b.view()[0] - c.capsules.previous_b.view()[0]) / 0.025f, 1e-3f);
}

}  // namespace
}  // namespace pleat
