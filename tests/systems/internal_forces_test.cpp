// What all forces inside a cloth have in common: they turn and move with it, and are none at rest.
#include <gtest/gtest.h>

#include "systems/edge_damping.h"
#include "systems/elastic_force.h"
#include "systems/hinge_bending.h"
#include "tests/components/skirt.h"
#include "tests/systems/sheet.h"

namespace pleat {
namespace {

using Force = void (*)(Sheet&);

void elastic(Sheet& s) { ElasticForce{&s.garment, s.position, s.inverse_mass, {30.0f}, 1e6f, s.force}.run(); }
void bending(Sheet& s) {
  HingeBending{&s.garment, s.position, s.velocity, s.inverse_mass,   1e-3f,
               4.0f,       1e-3f,      &s.packed,  &s.hinge_scratch, s.force}
      .run();
}
void damping(Sheet& s) {
  EdgeDamping{&s.garment, s.position, s.velocity, s.inverse_mass, 4.0f, 1e-3f, &s.packed, s.force}.run();
}

/// Turns by the unit quaternion (w, u).
Vec3 turned(const Vec3& v) {
  constexpr float w = 0.5f;
  constexpr Vec3 u{0.5f, -0.5f, 0.5f};
  return v + cross(u, cross(u, v) + v * w) * 2.0f;
}

class InternalForcesProperty : public testing::TestWithParam<Force> {};

TEST_P(InternalForcesProperty, TurnAndMoveWithTheCloth) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    Sheet sheet(make_skirt()), moved(make_skirt());
    shake(sheet.position, sheet.count, 0.02f, seed);
    shake(sheet.velocity, sheet.count, 1.0f, seed + 100);
    for (std::uint32_t i = 0; i < sheet.count; ++i) {
      moved.position.set(i, turned(sheet.position[i]) + Vec3{1, 2, -1});
      moved.velocity.set(i, turned(sheet.velocity[i]));
    }
    GetParam()(sheet);
    GetParam()(moved);
    float scale = 0.0f;
    for (std::uint32_t i = 0; i < sheet.count; ++i) scale = std::max(scale, length(sheet.force[i]));
    ASSERT_GT(scale, 0.0f);
    for (std::uint32_t i = 0; i < sheet.count; ++i) {
      EXPECT_LT(length(turned(sheet.force[i]) - moved.force[i]), 3e-4f * scale) << i;
    }
  }
}

TEST_P(InternalForcesProperty, AreNoneAtRest) {
  Sheet sheet(make_skirt());
  GetParam()(sheet);
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_LT(length(sheet.force[i]), 1e-5f) << i;
}

TEST_P(InternalForcesProperty, AddUpToNothing) {
  Sheet sheet(make_skirt());
  shake(sheet.position, sheet.count, 0.02f, 7);
  shake(sheet.velocity, sheet.count, 1.0f, 8);
  GetParam()(sheet);
  const Totals sum = totals(sheet.position, sheet.force, sheet.count);
  EXPECT_LT(length(sum.force), 3e-6 * sum.size);
  EXPECT_LT(length(sum.torque), 3e-6 * sum.size);
}

INSTANTIATE_TEST_SUITE_P(All, InternalForcesProperty, testing::Values(&elastic, &bending, &damping));

}  // namespace
}  // namespace pleat
