#include "systems/collision_response.h"

#include <gtest/gtest.h>

#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

/// One face in the plane y = 0 and a row that wants its point at `weight` 1 cm higher.
struct Scene {
  ContactCloth cloth;
  Stats stats;

  explicit Scene(const std::vector<std::uint32_t>& pins = {})
      : cloth({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}}, pins) {}

  void add(float a, float b, float c, bool at_particle = false) {
    const float w[] = {a, b, c};
    float yields = 0.0f;
    for (std::uint32_t k = 0; k < 3; ++k) yields += cloth.inverse_mass[k] * w[k] * w[k];
    cloth.contacts().add({.particle = {0, 1, 2},
                          .weight = {a, b, c},
                          .normal = {0, 1, 0},
                          .offset = 0.01f,
                          .body_step = {},
                          .friction = 0.0f,
                          .share = {cloth.inverse_mass[0] * a / yields, cloth.inverse_mass[1] * b / yields,
                                    cloth.inverse_mass[2] * c / yields},
                          .count = at_particle ? 1u : 3u,
                          .push = 0.0f,
                          .rubbed = 0.0f});
  }
  void run(FaceResponse response = FaceResponse::kWeighted) {
    cloth.run(CollisionResponse{.contacts = cloth.contacts(), .face_response = response}, stats);
  }
  float point_height(std::uint32_t row) {
    return contact_point(cloth.rows[row], ConstVec3View(cloth.position.view())).y;
  }
};

TEST(CollisionResponse, WeightedPutsThePointOnThePlane) {
  Scene s;
  s.cloth.inverse_mass[0] = 10.0f;  // 100 times as heavy as the others
  s.add(0.5f, 0.3f, 0.2f);
  s.run();
  EXPECT_NEAR(s.point_height(0), 0.01f, 1e-7f);
  EXPECT_NEAR(s.cloth.x(1).y / s.cloth.x(2).y, 1.5f, 1e-4f);
  EXPECT_NEAR(s.cloth.x(1).y / s.cloth.x(0).y, 1000.0f * 0.3f / (10.0f * 0.5f), 1e-2f);
  EXPECT_NEAR(s.cloth.rows[0].push, 0.01f, 1e-7f);
}

TEST(CollisionResponse, PinnedCornersStay) {
  for (const FaceResponse response : {FaceResponse::kWeighted, FaceResponse::kWhole}) {
    Scene s({0});
    s.add(0.4f, 0.3f, 0.3f);
    for (int i = 0; i < 60; ++i) s.run(response);
    EXPECT_EQ(s.cloth.x(0), Vec3{});
    EXPECT_NEAR(s.point_height(0), 0.01f, 1e-6f);
  }
}

TEST(CollisionResponse, WholeMovesTheCornersThatTouch) {
  Scene s;
  s.add(0.5f, 0.3f, 0.2f);
  s.run(FaceResponse::kWhole);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_NEAR(s.cloth.x(i).y, 0.01f, 1e-7f);
  Scene particle;
  particle.add(1, 0, 0, true);
  particle.run(FaceResponse::kWhole);
  EXPECT_EQ(particle.cloth.x(1).y, 0.0f);
}

TEST(CollisionResponse, CountsEachRowOnceAndLeavesSatisfiedOnes) {
  Scene s;
  s.add(1, 0, 0, true);
  s.add(0.5f, 0.5f, 0);
  s.add(0, 0, 1, true);
  s.cloth.rows[2].offset = -0.01f;
  for (int i = 0; i < 5; ++i) s.run();
  EXPECT_EQ(s.stats.particle_contacts, 1u);
  EXPECT_EQ(s.stats.face_contacts, 1u);
  EXPECT_EQ(s.cloth.x(2).y, 0.0f);
  EXPECT_EQ(s.cloth.rows[2].push, 0.0f);
}

TEST(CollisionResponse, ValidateRefusesBrokenFields) {
  Scene s;
  Vec4 place{};
  const CollisionResponse good{.contacts = s.cloth.contacts(), .position = &place};
  EXPECT_TRUE(good.validate());
  CollisionResponse bad = good;
  bad.contacts.count = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = nullptr;
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat::test
