// Which bodies a cloth meets: groups of bodies, and the groups that a cloth collides with.
#include <cmath>

#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_COLLISION

namespace pleat {
namespace {

constexpr std::uint32_t kLimbs = 2, kProps = 4;
constexpr float kCorners[] = {0, -0.2f, 0, 0.3f, -0.6f, 0, 0, -0.6f, 0.3f, 0, -1, 0};
constexpr std::uint32_t kFaces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

/// A body of each shape where a sheet that hangs from two corners would be; of a plane the sheet's lower half.
pleat_collider_def body_in_the_way(std::uint32_t shape) {
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def));
  EXPECT_EQ(def.groups, 1u);
  def.shape = shape;
  def.a[0] = -0.2f, def.b[0] = 0.2f, def.a[1] = def.b[1] = -0.4f;
  def.radius = 0.15f, def.radius_b = 0.2f;
  def.position[1] = -0.5f;
  for (float& extent : def.half_extents) extent = 0.2f;
  def.positions = kCorners, def.vertex_count = 4;
  def.triangles = kFaces, def.triangle_count = 4;
  def.groups = kLimbs;
  return def;
}

struct Met {
  std::vector<float> particles, vertices;
  pleat_contact_report report;
  pleat_stats stats;
};

/// Moves a body of any shape: of the three calls, the one for its shape does.
void move(Scene& scene, pleat_collider body, const pleat_collider_def& def, const float (&by)[3]) {
  float a[3], b[3], position[3], corners[12];
  for (std::size_t i = 0; i < 3; ++i) a[i] = def.a[i] + by[i], b[i] = def.b[i] + by[i];
  for (std::size_t i = 0; i < 3; ++i) position[i] = def.position[i] + by[i];
  for (std::size_t i = 0; i < 12; ++i) corners[i] = kCorners[i] + by[i % 3];
  call::collider_move_capsule(scene, body, a, b);
  call::collider_move_rigid(scene, body, position, def.rotation);
  call::collider_move_mesh(scene, body, corners, 0, 4);
}

constexpr int kTicks = 200;  // out of sight a cloth waits for some of the last

/// A sheet that swings down through where the body shakes at up to 9 m/s or, without one, does not.
Met play(const pleat_collider_def* body, std::uint32_t collides_with, bool visible = true) {
  Scene scene;
  pleat_collider collider{};
  if (body != nullptr) must(call::collider_create(scene, body, &collider));
  pleat_cloth_settings s = Scene::default_settings();
  EXPECT_EQ(s.collides_with, 0xffffffffu);
  s.collides_with = collides_with;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
  must(call::cloth_set_visible(scene, cloth, visible ? 1 : 0));
  for (int i = 0; i < kTicks; ++i) {
    if (body != nullptr) move(scene, collider, *body, {0, 0, 0.15f * std::sin(static_cast<float>(i))});
    scene.step();
  }
  must(call::cloth_set_visible(scene, cloth, 1));
  Met met{scene.particles(cloth), scene.vertices(cloth), {}, scene.stats()};
  met.report.size = sizeof met.report;
  must(call::cloth_contact_report(scene, cloth, &met.report));
  return met;
}

TEST(CollisionGroups, AClothMeetsBodiesOfItsGroupsAlone) {
  for (const bool visible : {true, false}) {
    const Met alone = play(nullptr, kLimbs, visible);
    for (std::uint32_t shape = 0; shape <= PLEAT_COLLIDER_HULL; ++shape) {
      const pleat_collider_def body = body_in_the_way(shape);
      const Met through = play(&body, ~kLimbs, visible), past = play(&body, kProps | kLimbs, visible);
      EXPECT_EQ(through.particles, alone.particles) << shape;
      EXPECT_EQ(through.vertices, alone.vertices) << shape;
      EXPECT_EQ(through.report.particle_contacts + through.report.face_contacts, 0u) << shape;
      EXPECT_EQ(through.report.face_depth, 0.0f) << shape;
      EXPECT_EQ(through.report.drawn_depth, 0.0f) << shape;
      EXPECT_EQ(through.stats.substeps, alone.stats.substeps) << shape;
      if (visible && (shape == PLEAT_COLLIDER_MESH || shape == PLEAT_COLLIDER_BOX || shape == PLEAT_COLLIDER_HULL)) {
        EXPECT_GT(past.stats.substeps, alone.stats.substeps + 99) << shape;
      }
      EXPECT_NE(past.particles, alone.particles) << shape;
    }
  }
}

TEST(CollisionGroups, ABodyInNoGroupIsMetByNobody) {
  pleat_collider_def body = body_in_the_way(PLEAT_COLLIDER_SPHERE);
  body.groups = 0;
  EXPECT_EQ(play(&body, 0xffffffff).particles, play(nullptr, 0xffffffff).particles);
}

TEST(CollisionGroups, AClothThatCollidesWithNothingLeavesContactOut) {
  Scene scene;
  scene.sphere(0, -0.4f, 0, 0.1f);
  pleat_cloth_settings s = Scene::default_settings();
  s.collides_with = 0;
  scene.cloth(scene.sheet(4), s);
  EXPECT_TRUE(scene.explain("capsule_detection").ends_with("left out: collides_with is 0"));
  EXPECT_TRUE(scene.explain("plane_detection").ends_with("left out: no plane"));
}

TEST(CollisionGroups, ChangeWhileTheWorldRuns) {
  for (std::uint32_t shape = 0; shape <= PLEAT_COLLIDER_HULL; ++shape) {
    Scene scene;
    const pleat_collider_def def = body_in_the_way(shape);
    pleat_collider body{};
    must(call::collider_create(scene, &def, &body));
    pleat_cloth_settings s = Scene::default_settings();
    s.sleep_speed = 0.05f;
    s.air_damping = 4.0f;
    s.collides_with = ~kLimbs;
    const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
    const auto asleep = [&] { return scene.stats().sleeping == 1; };
    const auto touches = [&] {
      scene.step(5);
      return scene.stats().particle_contacts + scene.stats().face_contacts != 0;
    };
    for (int i = 0; i < 1200 && !asleep(); ++i) scene.step();
    ASSERT_TRUE(asleep());
    move(scene, body, def, {0.05f, 0.1f, -0.6f});  // to where it hangs
    scene.step();
    pleat_collider other{};
    must(call::collider_create(scene, &def, &other));
    must(call::collider_set_enabled(scene, other, 0));
    must(call::collider_destroy(scene, other));
    scene.step();
    EXPECT_TRUE(asleep()) << "a body that is not met woke it: " << shape;

    pleat_collider_settings group{};
    group.size = sizeof group;
    must(call::collider_get(scene, body, &group));
    EXPECT_EQ(group.groups, kLimbs);
    must(call::collider_set(scene, body, &group));
    scene.step();
    EXPECT_TRUE(asleep()) << "groups as they were woke it: " << shape;
    group.groups = kProps;
    must(call::collider_set(scene, body, &group));
    EXPECT_TRUE(touches()) << shape;
    s.collides_with = kLimbs;
    must(call::cloth_set(scene, cloth, &s));
    EXPECT_FALSE(touches()) << shape;
    s.collides_with = kLimbs | kProps;
    must(call::cloth_set(scene, cloth, &s));
    EXPECT_TRUE(touches()) << shape;
  }
}

/// Two cloths of one garment, in one place, that meet different bodies: what a worker holds of one is not the other's.
TEST(CollisionGroups, ClothsOfOneGarmentHaveTheirOwn) {
  for (const std::uint32_t shape : {PLEAT_COLLIDER_CAPSULE, PLEAT_COLLIDER_HULL}) {
    const pleat_collider_def def = body_in_the_way(shape);
    Scene scene;
    pleat_collider body{};
    must(call::collider_create(scene, &def, &body));
    const pleat_garment sheet = scene.sheet(8);
    pleat_cloth_settings s = Scene::default_settings();
    s.collides_with = kProps;
    const pleat_cloth through = scene.cloth(sheet, s);
    s.collides_with = kLimbs;
    const pleat_cloth past = scene.cloth(sheet, s);
    for (int i = 0; i < kTicks; ++i) {
      move(scene, body, def, {0, 0, 0.15f * std::sin(static_cast<float>(i))});
      scene.step();
    }
    EXPECT_EQ(scene.particles(through), play(nullptr, kProps).particles);
    EXPECT_EQ(scene.particles(past), play(&def, kLimbs).particles);
  }
}

}  // namespace
}  // namespace pleat

#endif
