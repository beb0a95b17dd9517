#include "systems/collision_bodies.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "systems/capsule_shape.h"
#include "systems/collider_motion.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

CapsuleColumns random_capsules(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-5.0f, 5.0f), little(-0.2f, 0.2f);
  CapsuleColumns capsules(memory());
  for (Vec3Column* c : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
    c->resize(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 centre{place(random), place(random), place(random)};
    for (Vec3Column* c : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
      c->view().set(i, centre + Vec3{little(random), little(random), little(random)});
    }
    capsules.radius.push_back(0.1f);
    capsules.taper.push_back(i % 2 == 0 ? 0.05f : 0.0f);
    capsules.thickness.push_back(0.01f);
    capsules.friction.push_back(0.5f);
    capsules.groups.push_back(kFirstGroup);
    capsules.enabled.push_back(i % 7 != 0);
  }
  return capsules;
}

Box capsule_box(const CapsuleColumns& c, std::size_t i) {
  Box box;
  for (const Vec3Column* end : {&c.previous_a, &c.previous_b, &c.next_a, &c.next_b}) box.include(end->view()[i]);
  return box.grown(c.radius[i] + c.taper[i] + c.thickness[i]);
}

TEST(CollisionBodies, FindsEveryEnabledCapsuleThroughMovesAndRemovals) {
  std::mt19937 random(1);
  CollisionBodies bodies(memory());
  const Box asked{{-2, -2, -2}, {1, 2, 2}};
  for (const std::size_t count : {300u, 300u, 100u, 400u, 0u, 5u}) {
    const CapsuleColumns capsules = random_capsules(count, random);
    bodies.update_capsules(capsules);
    std::set<std::uint32_t> found;
    bodies.for_each_capsule(asked, [&](std::uint32_t i) { EXPECT_TRUE(found.insert(i).second); });
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool enabled = capsules.enabled[i] != 0;
      EXPECT_GE(found.count(i), enabled && capsule_box(capsules, i).overlaps(asked) ? 1u : 0u);
      EXPECT_LE(found.count(i), enabled ? 1u : 0u);
    }
    EXPECT_LE(found.size(), count);
  }
}

TEST(CollisionBodies, TheTreeOfTrianglesHasEachOnceInTheOrderOfBulletsTree) {
  for (const std::uint32_t detail : {0u, 1u, 3u}) {
    const BodyShape sphere = icosphere(static_cast<int>(detail), 1.0f);
    MeshCollider mesh = make_body(sphere.positions, sphere.triangles);
    CollisionBodies bodies(memory());
    bodies.add_mesh(mesh);
    std::vector<std::uint32_t> found, expected;
    bodies.for_each_triangle(0, {{-2, -2, -2}, {2, 2, 2}}, [&](std::uint32_t t) { expected.push_back(t); });
    const BoxTree& tree = bodies.triangle_boxes(0);
    const auto all_near = [](const BoxLanes& boxes) PLEAT_KERNEL_LAMBDA { return boxes.low.x <= boxes.high.x; };
    tree.for_each(all_near, [&](std::uint32_t leaf, std::uint32_t some) PLEAT_KERNEL_LAMBDA {
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        if ((some >> k & 1) != 0) found.push_back(tree.items(leaf)[k]);
      }
    });
    EXPECT_EQ(found.size(), mesh.triangles.size() / 3);
    EXPECT_EQ(found, expected);
  }
}

TEST(CollisionBodies, FindsEveryTriangleAlongItsSweep) {
  const BodyShape sphere = icosphere(3, 1.0f);
  MeshCollider mesh = make_body(sphere.positions, sphere.triangles);
  CollisionBodies bodies(memory());
  bodies.add_mesh(mesh);
  for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
    mesh.previous.view().set(i, sphere.positions[i] * 1.5f);
    mesh.next.view().set(i, sphere.positions[i] * 1.2f + Vec3{3, 0, 0});
  }
  bodies.update_mesh(0, mesh);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-2.0f, 4.0f);
  int hits = 0;
  for (int n = 0; n < 200; ++n) {
    const Vec3 corner{place(random), place(random), place(random)};
    const Box asked{corner, corner + Vec3{0.3f, 0.3f, 0.3f}};
    std::set<std::uint32_t> found;
    bodies.for_each_triangle(0, asked, [&](std::uint32_t t) { EXPECT_TRUE(found.insert(t).second); });
    for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t) {
      Box box;
      for (const std::uint32_t v : sphere.triangles[t]) {
        box.include(mesh.previous.view()[v]);
        box.include(mesh.next.view()[v]);
      }
      if (!box.overlaps(asked)) continue;
      EXPECT_EQ(found.count(t), 1u);
      ++hits;
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(CollisionBodies, RemovingAMeshClosesTheGap) {
  CollisionBodies bodies(memory());
  for (const float radius : {1.0f, 2.0f, 3.0f}) {
    const BodyShape s = icosphere(0, radius);
    bodies.add_mesh(make_body(s.positions, s.triangles));
  }
  bodies.remove_mesh(1);
  ASSERT_EQ(bodies.mesh_count(), 2u);
  EXPECT_GT(bodies.swept_box(1).high.x, 2.1f);
  EXPECT_LT(bodies.swept_box(0).high.x, 1.1f);
}

TEST(ColliderMotion, MovesNearCapsulesAndSortsThem) {
  std::mt19937 random(5);
  const CapsuleColumns capsules = random_capsules(500, random);
  CollisionBodies bodies(memory());
  bodies.update_capsules(capsules);
  ContactCloth cloth({{-1, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}});
  std::vector<CapsulePose> poses(64);
  std::uint32_t count = 0;
  Stats stats;
  Box sought;
  ColliderMotion motion{&capsules, &bodies, 3,      cloth.position.view(), {}, 0.5f, 0.25f, 0.5f, poses.data(),
                        64,        &count,  &sought};
  ASSERT_TRUE(motion.validate());
  motion.run(stats);
  ASSERT_GT(count, 1u);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t i = poses[k].index;
    EXPECT_TRUE(k == 0 || poses[k - 1].index < i);
    const Vec3 from = capsules.previous_a.view()[i], to = capsules.next_a.view()[i];
    EXPECT_LT(length(poses[k].a - (from + (to - from) * 0.5f)), 1e-6f);
    EXPECT_LT(length(poses[k].step_a - (to - from) * 0.25f), 1e-6f);
    EXPECT_EQ(poses[k].friction, 0.5f);
    EXPECT_FLOAT_EQ(widest_radius(poses[k]), i % 2 == 0 ? 0.16f : 0.11f);  // with its own thickness
  }
  EXPECT_EQ(stats.contacts_dropped, 0u);
  const std::uint32_t all = count;
  motion.capacity = 1, sought = {};
  motion.run(stats);
  EXPECT_EQ(count, 1u);
  EXPECT_GT(stats.contacts_dropped, 0u);
  EXPECT_LT(stats.contacts_dropped, all) << "those that are near, not those sought besides";
  EXPECT_FALSE(sought.holds(box_of(cloth.position.view(), 3))) << "kept what may not be all";
  motion.t0 = 1.0f, motion.t1 = 0.5f;
  EXPECT_FALSE(motion.validate());
}

TEST(ColliderMotion, KeepsWhatItFoundWhileTheClothStaysThere) {
  std::mt19937 random(6);
  const CapsuleColumns capsules = random_capsules(500, random);
  CollisionBodies bodies(memory());
  bodies.update_capsules(capsules);
  ContactCloth cloth({{-1, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}});
  std::vector<CapsulePose> kept(64), fresh(64);
  std::uint32_t kept_count = 0, fresh_count = 0;
  Box sought;
  Stats stats;
  std::uint32_t times_sought = 0;
  for (int substep = 0; substep < 20; ++substep) {
    const Vec3 before = sought.low;
    const Vec3View x = cloth.position.view();
    ColliderMotion{&capsules, &bodies, 3, x, {}, 0.2f, 0.25f, 0.5f, kept.data(), 64, &kept_count, &sought}.run(stats);
    Box anew;
    ColliderMotion{&capsules, &bodies, 3, x, {}, 0.2f, 0.25f, 0.5f, fresh.data(), 64, &fresh_count, &anew}.run(stats);
    const Box near = box_of(x, 3).grown(0.2f);
    for (std::uint32_t k = 0; k < fresh_count; ++k) {
      const auto same = [&](const CapsulePose& pose) { return pose.index == fresh[k].index && pose.a == fresh[k].a; };
      Box swept;
      const std::uint32_t i = fresh[k].index;
      for (const Vec3Column* end : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
        swept.include(end->view()[i]);
      }
      if (!swept.grown(widest_radius(fresh[k])).overlaps(near)) continue;
      EXPECT_TRUE(std::any_of(kept.begin(), kept.begin() + kept_count, same)) << i << " in substep " << substep;
    }
    times_sought += sought.low == before ? 0 : 1;
    for (std::uint32_t i = 0; i < 3; ++i) x.add(i, {0.03f, 0.0f, 0.0f});
  }
  EXPECT_EQ(times_sought, 5u);  // every 10 cm
  EXPECT_EQ(stats.contacts_dropped, 0u);
}

TEST(ColliderMotion, ABallThatHoldsTheOtherIsAllThereIs) {
  CapsuleColumns capsules(memory());
  for (Vec3Column* c : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) c->resize(2);
  for (std::uint32_t i = 0; i < 2; ++i) {
    capsules.previous_b.view().set(i, {0.1f, 0, 0});
    capsules.next_b.view().set(i, {0.1f, 0, 0});
    capsules.radius.push_back(i == 0 ? 0.05f : 0.3f);
    capsules.taper.push_back(i == 0 ? 0.25f : -0.25f);
    capsules.thickness.push_back(0.0f);
    capsules.friction.push_back(1.0f);
    capsules.groups.push_back(kFirstGroup);
    capsules.enabled.push_back(1);
  }
  CollisionBodies bodies(memory());
  bodies.update_capsules(capsules);
  ContactCloth cloth({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}});
  std::vector<CapsulePose> poses(2);
  std::uint32_t count = 0;
  Box sought;
  Stats stats;
  ColliderMotion{&capsules, &bodies, 3, cloth.position.view(), {}, 0.5f, 0.0f, 1.0f, poses.data(), 2, &count, &sought}
      .run(stats);
  ASSERT_EQ(count, 2u);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const float x = i == 0 ? 0.1f : 0.0f;
    EXPECT_EQ(poses[i].a, (Vec3{x, 0, 0}));
    EXPECT_EQ(poses[i].b, (Vec3{x, 0, 0}));
    EXPECT_FLOAT_EQ(poses[i].radius, 0.3f);
    EXPECT_EQ(poses[i].taper, 0.0f);
  }
}

}  // namespace
}  // namespace pleat::test
