#include "systems/surface_carry.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

const RigidMotion kMotion{{1, 2, 3}, {-4, 5, 6}, {0.6f, 0, 0, 0.8f}};

struct SurfaceCarryTest : testing::Test {
  Sheet sheet{make_grid({.rows = 5, .columns = 5})};

  SurfaceCarryTest() {
    shake(sheet.velocity, sheet.count, 1.0f, 3);
    shake(sheet.force, sheet.count, 1.0f, 4);
  }
  SurfaceCarry job() {
    return {.motion = kMotion,
            .vertex_count = sheet.count,
            .shaded_count = sheet.count - 2,
            .position = sheet.position,
            .normal = sheet.velocity,
            .tangent = sheet.force};
  }
};

TEST_F(SurfaceCarryTest, RefusesToRunWithAFieldMissing) {
  ASSERT_TRUE(job().validate());
  SurfaceCarry bad = job();
  bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.normal = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.tangent = {};
  EXPECT_TRUE(bad.validate());
}

TEST_F(SurfaceCarryTest, PlacesGoAlongAndDirectionsTurn) {
  std::vector<Vec3> place, normal, tangent;
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    place.push_back(kMotion.apply(sheet.position[i]));
    const bool shaded = i + 2 < sheet.count;
    normal.push_back(shaded ? rotate(kMotion.rotation, sheet.velocity[i]) : Vec3(sheet.velocity[i]));
    tangent.push_back(shaded ? rotate(kMotion.rotation, sheet.force[i]) : Vec3(sheet.force[i]));
  }
  for (const VectorSet set : kVectorSets) {
    Sheet fresh{make_grid({.rows = 5, .columns = 5})};
    shake(fresh.velocity, fresh.count, 1.0f, 3);
    shake(fresh.force, fresh.count, 1.0f, 4);
    SurfaceCarry carry = job();
    carry.position = fresh.position, carry.normal = fresh.velocity, carry.tangent = fresh.force;
    vector_limit = set;
    carry.run();
    vector_limit = VectorSet::kAvx512;
    for (std::uint32_t i = 0; i < fresh.count; ++i) {
      EXPECT_EQ(fresh.position[i], place[i]);
      EXPECT_EQ(fresh.velocity[i], normal[i]);
      EXPECT_EQ(fresh.force[i], tangent[i]);
    }
  }
}

}  // namespace
}  // namespace pleat
