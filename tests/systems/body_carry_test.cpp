#include "systems/body_carry.h"

#include <gtest/gtest.h>

#include <memory_resource>

#include "systems/collision_hull.h"

namespace pleat {
namespace {

const RigidMotion kJump{{0, 0, 0}, {10, 0, 0}, {0, 1, 0, 0}};  // half a turn about y

TEST(BodyCarry, CapsulesThatJumpAlongComeFromBeyondTheJump) {
  CapsuleColumns capsules(std::pmr::new_delete_resource());
  for (Vec3Column* column : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
    column->resize(2);
  }
  capsules.enabled.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    capsules.previous_a.view().set(i, {0.3f, 1, 0});
    capsules.previous_b.view().set(i, {0.3f, 0, 0});
  }
  capsules.next_a.view().set(0, {9.6f, 1, 0}), capsules.next_b.view().set(0, {9.7f, 0, 0});  // jumps, and moves a bit
  capsules.next_a.view().set(1, {0.4f, 1, 0}), capsules.next_b.view().set(1, {0.3f, 0, 0});  // stays where it was
  carry_along(kJump, capsules);
  EXPECT_LT(length(capsules.previous_a.view()[0] - Vec3{9.7f, 1, 0}), 1e-5f);
  EXPECT_LT(length(capsules.previous_b.view()[0] - Vec3{9.7f, 0, 0}), 1e-5f);
  EXPECT_EQ(capsules.previous_a.view()[1], (Vec3{0.3f, 1, 0}));
}

TEST(BodyCarry, BoxesKeepTheirShapeAndHaveAShorterWayToGo) {
  const Vec3 corners[] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                          {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
  MeshCollider box = build_hull(corners, std::pmr::new_delete_resource());
  place_rigid(box, {{0, 2, 1}, {}});
  move_rigid(box, {{10, 2, -1.1f}, {0, 1, 0, 0}});
  EXPECT_GT(box.bow, 1.0f);
  carry_along(kJump, box);
  EXPECT_LT(length(box.previous_pose.position - Vec3{10, 2, -1}), 1e-5f);
  EXPECT_LT(box.bow, 1e-5f);
  for (std::size_t i = 0; i < box.next.size(); ++i) {
    EXPECT_NEAR(length(box.next.view()[i] - box.previous.view()[i]), 0.1f, 1e-5f);
  }

  place_rigid(box, {{0, 2, 1}, {}});  // stands still
  carry_along(kJump, box);
  EXPECT_EQ(box.previous_pose.position, (Vec3{0, 2, 1}));
}

TEST(BodyCarry, TheGroundStays) {
  PlaneCollider ground, lift;
  lift.next.position = {10, 0.5f, 0};
  carry_along(kJump, ground);
  carry_along(kJump, lift);
  EXPECT_EQ(ground.previous, RigidPose{});
  EXPECT_EQ(lift.previous.position, (Vec3{10, 0, 0}));
}

}  // namespace
}  // namespace pleat
