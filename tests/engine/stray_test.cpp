// Vertices that no triangle uses stay with the cloth and do nothing to it.
#include <algorithm>
#include <cmath>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 6, kCloth = kSide * kSide;

/// A sheet of kSide x kSide, pinned at two corners, and behind it `strays` vertices that no triangle uses.
pleat_garment sheet_with(Scene& scene, std::uint32_t strays) {
  pleat_shape_def shape;
  must(call::shape_def_init(&shape, sizeof shape));
  shape.rows = shape.columns = kSide;
  std::vector<float> positions(3 * (kCloth + strays));
  std::vector<std::uint32_t> triangles(6 * (kSide - 1) * (kSide - 1));
  must(call::shape_build(&shape, positions.data(), triangles.data()));
  for (std::uint32_t i = 3 * kCloth; i < positions.size(); ++i) positions[i] = 0.3f * static_cast<float>(i % 5);
  const std::uint32_t pins[] = {0, kSide - 1};
  pleat_garment_def def;
  must(call::garment_def_init(&def, sizeof def));
  def.positions = positions.data();
  def.vertex_count = kCloth + strays;
  def.triangles = triangles.data();
  def.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
  def.pins = pins;
  def.pin_count = 2;
  pleat_garment garment{};
  must(call::garment_create(scene, &def, nullptr, &garment));
  return garment;
}

/// Moves the pins to `x` along the x axis.
void pull(Scene& scene, pleat_cloth cloth, float x) {
  const float pins[] = {x - 0.5f, 0, -0.5f, x + 0.5f, 0, -0.5f};
  must(call::cloth_move_pins(scene, cloth, pins, 0, 2));
}

[[maybe_unused]] std::vector<float> of_the_cloth(Scene& scene, pleat_cloth cloth) {
  const std::vector<float> all = scene.particles(cloth);
  const auto velocities = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::vector<float> own(all.begin(), all.begin() + 3 * kCloth);
  own.insert(own.end(), velocities, velocities + 3 * kCloth);
  return own;
}

float extent(Scene& scene, pleat_cloth cloth) {
  float low[3], high[3], most = 0.0f;
  must(call::cloth_bounds(scene, cloth, low, high));
  for (int k = 0; k < 3; ++k) most = std::max(most, high[k] - low[k]);
  return most;
}

TEST(Stray, StaysInTheBoxOfAClothThatWalks) {
  for (const std::uint32_t visible : {1u, 0u}) {
    Scene scene;
    const pleat_cloth cloth = scene.cloth(sheet_with(scene, 3));
    must(call::cloth_set_visible(scene, cloth, visible));
    EXPECT_LT(extent(scene, cloth), 1.1f);
    for (int tick = 1; tick <= 600; ++tick) {
      pull(scene, cloth, 10.0f * static_cast<float>(tick) / 60.0f);
      scene.step();
      ASSERT_LT(extent(scene, cloth), 2.0f) << "tick " << tick;
    }
  }
}

TEST(Stray, IsWhereTheClothIsPutAndDoesNotDriftAway) {
  Scene scene;
  pleat_cloth_settings settings = Scene::default_settings();
  settings.inner_friction = 0.0f;
  const pleat_cloth cloth = scene.cloth(sheet_with(scene, 2), settings);
  std::vector<float> state = scene.particles(cloth);
  for (std::size_t i = 3 * kCloth; i < state.size(); ++i) state[i] = 5.0f;
  const std::size_t half = state.size() / 2;
  std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(half), 3 * kCloth, 0.0f);
  must(call::cloth_write_particles(scene, cloth, state.data(), state.data() + half, kCloth + 2));
  EXPECT_LT(extent(scene, cloth), 1.1f);
  scene.step(120);
  EXPECT_LT(extent(scene, cloth), 2.0f);
}

#ifdef PLEAT_WITH_COLLISION
TEST(Stray, AsksForNoSubstepsWhereBodyAndClothGoFastTogether) {
  std::uint32_t substeps[2] = {};
  for (const std::uint32_t strays : {0u, 3u}) {
    Scene scene;
    pleat_cloth_settings settings = Scene::default_settings();
    settings.teleport_speed = 0.0f;
    const pleat_cloth cloth = scene.cloth(sheet_with(scene, strays), settings);
    const pleat_collider body = scene.sphere(0, 0, -0.5f, 0.02f);
    for (int tick = 1; tick <= 240; ++tick) {  // up to 30 m/s
      const float t = static_cast<float>(tick) / 60.0f, x = 3.75f * t * t;
      pull(scene, cloth, x);
      const float at[3] = {x, 0, -0.5f};
      must(call::collider_move_capsule(scene, body, at, at));
      scene.step();
    }
    substeps[strays != 0] = scene.info(cloth).substeps;
    EXPECT_EQ(scene.stats().fast_bodies, 0u) << strays;
  }
  EXPECT_EQ(substeps[1], substeps[0]);
}

TEST(Stray, ChangesNothingOfTheCloth) {
  std::vector<float> without;
  for (const std::uint32_t strays : {0u, 1u, 40u}) {
    Scene scene;
    pleat_cloth_settings settings = Scene::default_settings();
    settings.self_distance = 0.02f;
    const pleat_cloth cloth = scene.cloth(sheet_with(scene, strays), settings);
    std::uint64_t touching = 0;
    for (int tick = 1; tick <= 120; ++tick) {  // shaken so that it touches itself
      pull(scene, cloth, 0.5f * std::sin(9.0f * static_cast<float>(tick) / 60.0f));
      scene.step();
      touching += scene.stats().self_contacts;
    }
    EXPECT_GT(touching, 0u);
    if (strays == 0) without = of_the_cloth(scene, cloth);
    EXPECT_TRUE(same_bits(of_the_cloth(scene, cloth), without)) << strays;
    EXPECT_EQ(scene.stats().rollbacks, 0u);
  }
}
#endif

TEST(Stray, IsARowOfTheScheduleOnlyWhereThereIsOne) {
  Scene scene;
  scene.cloth(sheet_with(scene, 0));
  EXPECT_TRUE(scene.explain("stray_carry").ends_with("left out: every vertex has a triangle or is a pin"));
  scene.cloth(sheet_with(scene, 1));
  EXPECT_NE(scene.explain("stray_carry").find("run for 1 of 2"), std::string::npos);
}

}  // namespace
}  // namespace pleat
