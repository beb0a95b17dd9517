#include "systems/penetration.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "systems/capsule_shape.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

/// One triangle with corners 0.4 m from the origin, at a height; particle 0 is pinned.
ContactCloth triangle_at(float height) {
  const float s = 0.2f * std::numbers::sqrt3_v<float>;
  return {{{0.0f, height, 0.4f}, {s, height, -0.2f}, {-s, height, -0.2f}}, {{0, 1, 2}}, {0}};
}

void add_capsule(CapsuleColumns& c, const Vec3& a, const Vec3& b, float radius, float taper = 0.0f) {
  const std::size_t i = c.size();
  for (Vec3Column* column : {&c.previous_a, &c.previous_b, &c.next_a, &c.next_b}) column->resize(i + 1);
  for (Column<float>* column : {&c.radius, &c.taper, &c.thickness, &c.friction}) column->resize(i + 1);
  c.enabled.resize(i + 1), c.groups.push_back(kFirstGroup);
  c.previous_a.view().set(i, a), c.next_a.view().set(i, a + Vec3{0, 10, 0});
  c.previous_b.view().set(i, b), c.next_b.view().set(i, b + Vec3{0, 10, 0});
  c.radius[i] = radius, c.taper[i] = taper, c.thickness[i] = 0.3f, c.enabled[i] = 1;
}

PenetrationDepths depths(const ContactCloth& cloth, const CapsuleColumns& capsules) {
  const Penetration in{.garment = &cloth.garment, .position = cloth.position.view(), .capsules = &capsules};
  EXPECT_TRUE(in.validate());
  return in.run();
}

TEST(Penetration, CapsulesAreExactAtTheTicksStartAndWithoutTheirThickness) {
  CapsuleColumns far(memory()), ball(memory()), pole(memory()), tapered(memory());
  add_capsule(far, {0, 1, 0}, {0, 2, 0}, 0.5f);
  EXPECT_EQ(depths(triangle_at(0.0f), far).face, 0.0f);
  EXPECT_FALSE(depths(triangle_at(0.0f), far).deepest);

  add_capsule(ball, {0, 0.07f, 0}, {0, 0.07f, 0}, 0.1f);  // under the middle of the face
  const PenetrationDepths from_ball = depths(triangle_at(0.0f), ball);
  EXPECT_EQ(from_ball.particle, 0.0f);
  EXPECT_NEAR(from_ball.face, 0.03f, 1e-6f);
  EXPECT_EQ(from_ball.drawn, from_ball.face);  // no pattern: the coarse triangles are drawn
  ASSERT_TRUE(from_ball.deepest);
  EXPECT_EQ(from_ball.deepest->kind, ColliderKind::kCapsule);

  add_capsule(pole, {0, -1, 0.4f}, {0, 1, 0.4f}, 0.05f);  // through the pinned corner
  add_capsule(pole, {0, -1, 0}, {0, 1, 0}, 0.02f);        // through the face
  const PenetrationDepths from_pole = depths(triangle_at(0.0f), pole);
  EXPECT_NEAR(from_pole.pin, 0.05f, 1e-6f);
  EXPECT_EQ(from_pole.pins_inside, 1u);
  EXPECT_EQ(from_pole.particle, 0.0f);
  EXPECT_EQ(from_pole.deepest->index, 0u);
  pole.enabled[0] = 0;
  const PenetrationDepths from_second = depths(triangle_at(0.0f), pole);
  EXPECT_NEAR(from_second.face, 0.02f, 1e-6f);
  EXPECT_EQ(from_second.pins_inside, 0u);
  EXPECT_EQ(from_second.deepest->index, 1u);

  add_capsule(tapered, {0, -0.5f, 0}, {0, 0.5f, 0}, 0.1f, -0.06f);  // pierced where it is 7 cm thick
  EXPECT_NEAR(depths(triangle_at(0.0f), tapered).face, 0.07f / std::sqrt(1.0f - 0.06f * 0.06f), 2e-4f);
}

/// Two pins may be outside and the edge between them inside: no contact can move it.
TEST(Penetration, AnEdgeBetweenPinsIsAsDeepAsItsDeepestPoint) {
  ContactCloth cloth = triangle_at(0.0f);
  CapsuleColumns ball(memory());
  const Vec3 middle = (cloth.position.view()[1] + cloth.position.view()[2]) * 0.5f;
  add_capsule(ball, middle + Vec3{0, 0.07f, 0}, middle + Vec3{0, 0.07f, 0}, 0.1f);
  EXPECT_EQ(depths(cloth, ball).pin, 0.0f);  // one end is free
  const float s = 0.2f * std::numbers::sqrt3_v<float>;
  const ContactCloth held({{0.0f, 0.0f, 0.4f}, {s, 0.0f, -0.2f}, {-s, 0.0f, -0.2f}}, {{0, 1, 2}}, {1, 2});
  const PenetrationDepths found = depths(held, ball);
  EXPECT_NEAR(found.pin, 0.03f, 1e-6f);
  EXPECT_NEAR(found.face, 0.03f, 1e-6f);
  EXPECT_EQ(found.pins_inside, 0u);
  EXPECT_EQ(found.particle, 0.0f);
}

TEST(Penetration, PropertyCapsulesAgreeWithDenseSamples) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
  const auto point = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  for (int trial = 0; trial < 100; ++trial) {
    const ContactCloth cloth({point(), point(), point()}, {{0, 1, 2}});
    CapsuleColumns capsules(memory());
    add_capsule(capsules, point(), point(), 0.2f, trial % 2 != 0 ? 0.1f : 0.0f);
    CapsulePose pose;
    pose.a = capsules.previous_a.view()[0], pose.b = capsules.previous_b.view()[0], pose.radius = 0.2f;
    pose.taper = capsules.taper[0];
    float sampled = 0.0f;
    for (int i = 0; i <= 40; ++i) {
      for (int j = 0; i + j <= 40; ++j) {
        const float b = 0.025f * static_cast<float>(i), c = 0.025f * static_cast<float>(j);
        sampled = std::max(sampled, -signed_distance(cloth.x(0) * (1 - b - c) + cloth.x(1) * b + cloth.x(2) * c, pose));
      }
    }
    const float depth = depths(cloth, capsules).face;
    EXPECT_GE(depth, sampled - 1e-5f) << trial;
    EXPECT_LT(depth, sampled + 0.02f) << trial;
  }
}

TEST(Penetration, PlanesAndMeshes) {
  const ContactCloth cloth = triangle_at(0.05f);
  PlaneCollider planes[2];
  planes[0].previous.position = {0, 0.06f, 0}, planes[0].thickness = 1.0f;
  planes[1].previous.position = {0, 0.9f, 0}, planes[1].enabled = false;
  const BodyShape shape = box_shape({0.1f, 0.1f, 0.1f});
  const MeshCollider box = make_body(shape.positions, shape.triangles);
  const MeshCollider* meshes[] = {&box};
  CollisionBodies bodies(memory());
  bodies.add_mesh(box);
  const Penetration in{.garment = &cloth.garment,
                       .position = cloth.position.view(),
                       .planes = planes,
                       .plane_count = 2,
                       .meshes = meshes,
                       .bodies = &bodies};
  ASSERT_TRUE(in.validate());
  PenetrationDepths found = in.run();
  EXPECT_NEAR(found.particle, 0.01f, 1e-6f);  // below the plane
  EXPECT_NEAR(found.pin, 0.01f, 1e-6f);
  EXPECT_EQ(found.pins_inside, 1u);
  EXPECT_NEAR(found.face, 0.05f, 1e-6f);  // in the box, 5 cm below its top; the samples hit its middle
  ASSERT_TRUE(found.deepest);
  EXPECT_EQ(found.deepest->kind, ColliderKind::kMesh);

  planes[0].previous.position.y = 0.15f;
  EXPECT_EQ(in.run().deepest->kind, ColliderKind::kPlane);
}

TEST(Penetration, AMeshKnowsItsSideAndAnOpenOneHasNoneBesideItsBorder) {
  const BodyShape round = icosphere(3, 0.5f);
  const MeshCollider ball = make_body(round.positions, round.triangles);
  const MeshCollider sheet = make_body({{-1, 0, -1}, {1, 0.3f, -1}, {1, 0, 1}, {-1, 0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const MeshCollider* meshes[] = {&ball, &sheet};
  CollisionBodies bodies(memory());
  bodies.add_mesh(ball);
  const auto depth_at = [&](const Vec3& p) {
    const ContactCloth cloth({p, p + Vec3{0, 0, 1e-4f}, p + Vec3{1e-4f, 0, 0}}, {{0, 1, 2}});
    const Penetration in{
        .garment = &cloth.garment, .position = cloth.position.view(), .meshes = meshes, .bodies = &bodies};
    return in.run().face;
  };
  for (const float radius : {0.1f, 0.3f, 0.45f, 0.6f, 3.0f}) {
    const Vec3 direction = normalized_or(Vec3{0.3f, -0.5f, 0.7f}, Vec3{});
    EXPECT_NEAR(depth_at(direction * radius), std::max(0.5f - radius, 0.0f), 0.01f)
        << radius;  // 642 corners: flat faces
  }
  bodies.remove_mesh(0);
  meshes[0] = &sheet;
  bodies.add_mesh(sheet);
  EXPECT_EQ(depth_at({1.0f, 0.25f, 0.0f}), 0.0f);  // its solid side is up; here a border is nearest
  EXPECT_GT(depth_at({0.3f, 0.2f, -0.2f}), 0.1f);  // here the face is
}

TEST(Penetration, IncompleteQuestionsAreSeen) {
  const ContactCloth cloth = triangle_at(0.0f);
  const Penetration good{.garment = &cloth.garment, .position = cloth.position.view()};
  EXPECT_TRUE(good.validate());
  EXPECT_EQ(good.run().face, 0.0f);
  EXPECT_FALSE(Penetration{}.validate());
  Penetration bad = good;
  bad.plane_count = 1;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.t = 1.5f;
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat::test
