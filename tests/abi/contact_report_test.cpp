#include <gtest/gtest.h>

#include <cstddef>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

class ContactReport : public Host {
 protected:
  pleat_contact_report report() {
    pleat_contact_report r{};
    r.size = sizeof r;
    EXPECT_EQ(api().cloth_contact_report(world, cloth, &r), pleat_result{PLEAT_OK}) << services.log;
    return r;
  }
  /// A ball of 20 cm.
  pleat_collider ball(float x, float y, float z) {
    pleat_collider_def def = made(api().collider_def_init);
    def.shape = PLEAT_COLLIDER_SPHERE;
    def.a[0] = x, def.a[1] = y, def.a[2] = z, def.radius = 0.2f;
    pleat_collider out{};
    EXPECT_EQ(api().collider_create(world, &def, &out), pleat_result{PLEAT_OK});
    return out;
  }
};

TEST_F(ContactReport, MistakesAreRefused) {
  pleat_contact_report r{};
  r.size = sizeof r;
  expect_refused(PLEAT_ERROR_ARGUMENT, "report", [&] { return api().cloth_contact_report(world, cloth, nullptr); });
  expect_refused(PLEAT_ERROR_HANDLE, "cloth", [&] { return api().cloth_contact_report(world, {9, 1}, &r); });
  EXPECT_EQ(api().cloth_contact_report(nullptr, cloth, &r), pleat_result{PLEAT_ERROR_ARGUMENT});
  for (const std::uint32_t size : {0u, 3u, 44u, std::uint32_t{sizeof r + 1}}) {
    r.size = size;
    expect_refused(PLEAT_ERROR_ARGUMENT, "report.size", [&] { return api().cloth_contact_report(world, cloth, &r); });
  }
}

TEST_F(ContactReport, AnOlderHostsStructIsNotOverrun) {
  pleat_contact_report r{};
  r.size = offsetof(pleat_contact_report, particle_depth);
  r.particle_depth = 7.0f;
  EXPECT_EQ(api().cloth_contact_report(world, cloth, &r), pleat_result{PLEAT_OK});
  EXPECT_EQ(r.particle_depth, 7.0f);
}

TEST_F(ContactReport, NothingTouchesNothing) {
  const pleat_contact_report r = report();
  EXPECT_EQ(r.particle_contacts + r.face_contacts + r.self_contacts + r.contacts_dropped, 0u);
  EXPECT_EQ(r.particle_depth + r.pin_depth + r.face_depth + r.drawn_depth, 0.0f);
  EXPECT_EQ(r.deepest.generation, 0u);
}

TEST_F(ContactReport, NamesTheDeepestAndThePinsInIt) {
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "collision is compiled out";
  std::vector<float> flat = square.positions;  // 1 m2 in the xz plane, pins at (-.5, -.5) and (.5, -.5)
  ASSERT_EQ(api().cloth_write_particles(world, cloth, flat.data(), nullptr, 9), pleat_result{PLEAT_OK});
  const pleat_collider gone = ball(0.0f, 5.0f, 0.0f), under = ball(0.25f, -0.19f, 0.2f),
                       pinned = ball(0.5f, 0.05f, -0.5f);
  ASSERT_EQ(api().collider_destroy(world, gone), pleat_result{PLEAT_OK});  // the others move down, their names stay
  pleat_contact_report r = report();
  EXPECT_EQ(r.pins_inside, 1u);
  EXPECT_NEAR(r.pin_depth, 0.15f, 1e-6f);
  EXPECT_NEAR(r.face_depth, 0.15f, 1e-6f);
  EXPECT_EQ(r.particle_depth, 0.0f);
  EXPECT_EQ(r.deepest.index, pinned.index);
  EXPECT_EQ(r.deepest.generation, pinned.generation);

  ASSERT_EQ(api().collider_set_enabled(world, pinned, 0), pleat_result{PLEAT_OK});
  r = report();
  EXPECT_EQ(r.pins_inside, 0u);
  EXPECT_NEAR(r.face_depth, 0.01f, 1e-6f);
  EXPECT_EQ(r.deepest.index, under.index);
  const float far[3] = {0, 0, 0};  // a move counts from the next tick on
  ASSERT_EQ(api().collider_move_capsule(world, under, far, far), pleat_result{PLEAT_OK});
  EXPECT_NEAR(report().face_depth, 0.01f, 1e-6f);
}

TEST_F(ContactReport, CountsAreThoseOfTheClothsLastTick) {
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "collision is compiled out";
  ball(0.0f, -0.25f, 0.0f);
  pleat_cloth_def def = made(api().cloth_def_init);
  def.garment = garment;
  std::vector<float> above = square.positions;
  for (std::size_t i = 0; i < 9; ++i) above[3 * i + 1] += 50.0f;
  def.positions = above.data();
  pleat_cloth other{};
  ASSERT_EQ(api().cloth_create(world, &def, &other), pleat_result{PLEAT_OK});
  for (int tick = 0; tick < 60; ++tick) ASSERT_EQ(api().world_step(world, 1.0f / 60.0f), pleat_result{PLEAT_OK});
  pleat_stats stats{};
  stats.size = sizeof stats;
  ASSERT_EQ(api().world_stats(world, &stats), pleat_result{PLEAT_OK});
  const pleat_contact_report touching = report();
  EXPECT_GT(touching.particle_contacts + touching.face_contacts, 0u);
  EXPECT_EQ(touching.particle_contacts, stats.particle_contacts);
  EXPECT_EQ(touching.face_contacts, stats.face_contacts);
  cloth = other;
  EXPECT_EQ(report().particle_contacts + report().face_contacts, 0u);
}

}  // namespace
}  // namespace pleat::abi
