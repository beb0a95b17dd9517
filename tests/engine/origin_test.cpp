// Cloth far from the world's origin moves as it does there.
#include "engine/origin.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

using Place = std::array<float, 3>;

constexpr Place kHere{0, 0, 0}, kFar{1024, 256, -2048};  // where floats resolve .0001 m

/// A sheet of 1 m that hangs from two corners, a second one over it in a higher layer, and a body of each kind.
struct Figure : Scene {
  Place at;
  pleat_cloth lower, upper;
#ifdef PLEAT_WITH_COLLISION
  pleat_collider ball, box, ground;
#endif

  explicit Figure(const Place& place) : at(place), lower(sheet_at(0.0f, 1)), upper(sheet_at(0.0625f, 2)) {
#ifdef PLEAT_WITH_COLLISION
    ball = sphere(at[0], at[1] - 0.25f, at[2] + 0.125f, 0.15625f);
    box = body(PLEAT_COLLIDER_BOX, {0.25f, -0.5f, 0.25f});
    ground = body(PLEAT_COLLIDER_PLANE, {0, -0.75f, 0});
#endif
  }
  Place place(float x, float y, float z) const { return {at[0] + x, at[1] + y, at[2] + z}; }
  pleat_cloth sheet_at(float height, std::uint32_t layer) {
    constexpr std::uint32_t kSide = 9;
    const pleat_garment garment = sheet(kSide);
    std::vector<float> x;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const Place p = place(static_cast<float>(i % kSide) / 8 - 0.5f, height, static_cast<float>(i / kSide) / 8 - 0.5f);
      x.insert(x.end(), p.begin(), p.end());
    }
    pleat_cloth_def def;
    must(call::cloth_def_init(&def, sizeof def));
    def.garment = garment, def.positions = x.data(), def.settings.layer = layer;
    pleat_cloth cloth{};
    must(call::cloth_create(*this, &def, &cloth));
    return cloth;
  }
#ifdef PLEAT_WITH_COLLISION
  pleat_collider body(std::uint32_t shape, const Place& where) {
    pleat_collider_def def;
    must(call::collider_def_init(&def, sizeof def));
    def.shape = shape;
    const Place p = place(where[0], where[1], where[2]);
    std::copy(p.begin(), p.end(), def.position);
    std::fill(std::begin(def.half_extents), std::end(def.half_extents), 0.125f);
    pleat_collider collider{};
    must(call::collider_create(*this, &def, &collider));
    return collider;
  }
#endif
  /// A swaying tick: everything moves by multiples of 1/64 m, which floats hold at both places.
  void sway(int tick) {
    const float x = static_cast<float>(tick % 8 < 4 ? tick % 8 : 8 - tick % 8) / 64;
    for (const pleat_cloth cloth : {lower, upper}) {
      const float height = cloth.index == upper.index ? 0.0625f : 0.0f;
      const Place a = place(x - 0.5f, height, -0.5f), b = place(x + 0.5f, height, -0.5f);
      const float pins[] = {a[0], a[1], a[2], b[0], b[1], b[2]};
      must(call::cloth_move_pins(*this, cloth, pins, 0, 2));
    }
#ifdef PLEAT_WITH_COLLISION
    const Place centre = place(-x, -0.25f, 0.125f), corner = place(0.25f, -0.5f + x, 0.25f);
    const float turn[] = {0, 0, 0, 1};
    must(call::collider_move_capsule(*this, ball, centre.data(), centre.data()));
    must(call::collider_move_rigid(*this, box, corner.data(), turn));
#endif
    step();
  }
  /// Positions less the place, then velocities.
  std::vector<float> state(pleat_cloth cloth) {
    std::vector<float> x = particles(cloth);
    for (std::size_t i = 0; i < x.size() / 2; ++i) x[i] -= at[i % 3];
    return x;
  }
};

float farthest_apart(const std::vector<float>& a, const std::vector<float>& b) {
  float most = 0.0f;
  for (std::size_t i = 0; i < a.size() / 2; ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

std::vector<float> velocities(const std::vector<float>& state) {
  return {state.begin() + static_cast<std::ptrdiff_t>(state.size() / 2), state.end()};
}

TEST(Origin, FarAwayEverythingGoesAsItDoesAtZero) {
  Figure here(kHere), there(kFar);
  for (int tick = 0; tick < 90; ++tick) {
    here.sway(tick), there.sway(tick);
    for (const auto& [a, b] : {std::pair{here.lower, there.lower}, std::pair{here.upper, there.upper}}) {
      ASSERT_TRUE(same_bits(velocities(here.state(a)), velocities(there.state(b)))) << "tick " << tick;
      ASSERT_LT(farthest_apart(here.state(a), there.state(b)), 2e-4f) << "tick " << tick;
    }
  }
#ifdef PLEAT_WITH_COLLISION
  pleat_contact_report report_here{}, report_there{};
  report_here.size = report_there.size = sizeof report_here;
  must(call::cloth_contact_report(here, here.upper, &report_here));
  must(call::cloth_contact_report(there, there.upper, &report_there));
  EXPECT_GT(report_here.particle_contacts + report_here.face_contacts + report_here.self_contacts, 0u);
  EXPECT_EQ(std::memcmp(&report_here, &report_there, sizeof report_here), 0);
  EXPECT_GT(here.stats().particle_contacts, 0u);
#endif
}

TEST(Origin, WhatTheHostReadsIsOfTheWorld) {
  Figure here(kHere), there(kFar);
  for (int tick = 0; tick < 20; ++tick) here.sway(tick), there.sway(tick);
  const std::vector<float> a = here.vertices(here.lower), b = there.vertices(there.lower);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t v = 0; v < a.size(); v += 8) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[v + k] + kFar[k], b[v + k], 2e-4f);
    EXPECT_EQ(std::memcmp(&a[v + 3], &b[v + 3], 3 * sizeof(float)), 0) << "normal of vertex " << v / 8;
  }
  float low[3], high[3], far_low[3], far_high[3];
  must(call::cloth_bounds(here, here.lower, low, high));
  must(call::cloth_bounds(there, there.lower, far_low, far_high));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(low[k] + kFar[k], far_low[k], 2e-4f);
    EXPECT_NEAR(high[k] + kFar[k], far_high[k], 2e-4f);
  }
  Place first{};
  const auto keep = [](const float* from, const float*, std::uint32_t, void* user) {
    Place& place = *static_cast<Place*>(user);
    if (place == Place{}) place = {from[0], from[1], from[2]};
  };
  must(call::world_debug_draw(there, PLEAT_DEBUG_COARSE_EDGES, keep, &first));
  EXPECT_NEAR(first[0], kFar[0], 1.0f);
  EXPECT_NEAR(first[2], kFar[2], 1.0f);
}

TEST(Origin, AStateThatIsWrittenElsewhereGoesOnThere) {
  Figure here(kHere), there(kFar);
  for (int tick = 0; tick < 20; ++tick) here.sway(tick);
  std::vector<float> state = here.particles(here.lower);
  const auto count = static_cast<std::uint32_t>(state.size() / 6);
  for (std::uint32_t i = 0; i < 3 * count; ++i) state[i] += kFar[i % 3];
  must(call::cloth_write_particles(there, there.lower, state.data(), state.data() + 3 * count, count));
  const std::vector<float> back = there.particles(there.lower);
  EXPECT_TRUE(same_bits(state, back));
}

TEST(Origin, AJumpOfAKilometreIsCarriedAndThenSeenFromThere) {
  Figure stays(kHere), jumps(kHere);
  for (int tick = 0; tick < 20; ++tick) stays.sway(tick), jumps.sway(tick);
  for (const pleat_cloth cloth : {jumps.lower, jumps.upper}) {
    must(call::cloth_teleport(jumps, cloth, kHere.data(), kFar.data(), nullptr));
  }
  jumps.at = kFar;
#ifdef PLEAT_WITH_COLLISION
  const Place ground = jumps.place(0, -0.75f, 0);
  const float turn[] = {0, 0, 0, 1};
  must(call::collider_move_rigid(jumps, jumps.ground, ground.data(), turn));
#endif
  // By the jump itself positions lose what a float does not hold there, once; then sides of layers are sought anew.
  for (int tick = 20; tick < 23; ++tick) {
    stays.sway(tick), jumps.sway(tick);
    ASSERT_EQ(jumps.stats().teleports, 2u);
    ASSERT_LT(farthest_apart(stays.state(stays.lower), jumps.state(jumps.lower)), 1e-3f) << "tick " << tick;
    ASSERT_LT(farthest_apart(stays.state(stays.upper), jumps.state(jumps.upper)), 1e-3f) << "tick " << tick;
  }
}

TEST(Origin, DrawnVerticesComeAlongWhereNothingIsDrawnAnew) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(5));
  scene.step(20);
  const std::vector<float> before = scene.vertices(cloth), state = scene.particles(cloth);
  World& world = scene.inside();
  for (Vec3Column* column : {&world.particles.position, &world.drawn.position, &world.pin_previous, &world.pin_next}) {
    for (float& x : column->x) x += 24.0f;
  }
  recentre(world, world.clothes[0]);
  EXPECT_EQ(world.clothes[0].origin, (Vec3{24, 0, 0}));
  const std::vector<float> after = scene.vertices(cloth), moved = scene.particles(cloth);
  for (std::size_t v = 0; v < before.size(); v += 8) ASSERT_NEAR(after[v], before[v] + 24.0f, 1e-5f);
  for (std::size_t i = 0; i < state.size() / 2; i += 3) ASSERT_NEAR(moved[i], state[i] + 24.0f, 1e-5f);
}

TEST(Origin, TheWorldEndsWhereTheBorderSays) {
  Scene scene;
  pleat_garment_def garment_def;
  must(call::garment_def_init(&garment_def, sizeof garment_def));
  const float x[] = {0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f};
  const std::uint32_t triangle[] = {0, 1, 2};
  garment_def.positions = x, garment_def.vertex_count = 3, garment_def.triangles = triangle;
  garment_def.triangle_count = 1;
  pleat_cloth_def def;
  must(call::cloth_def_init(&def, sizeof def));
  must(call::garment_create(scene, &garment_def, nullptr, &def.garment));
  const float low[] = {0, -999990, 0, 0.5f, -999990, 0, 0, -999990, 0.5f};
  def.positions = low;
  pleat_cloth cloth{};
  must(call::cloth_create(scene, &def, &cloth));
  scene.step(300);  // it would fall by 100 m
  const std::vector<float> state = scene.particles(cloth);
  EXPECT_LT(state[1], -999995.0f);
  must(call::cloth_write_particles(scene, cloth, state.data(), state.data() + 9, 3));  // still taken
}

TEST(Origin, FarAwayItComesToRestAndSleeps) {
  for (const float distance : {0.0f, 100.0f, 2000.0f, 30000.0f}) {
    Scene scene;
    pleat_cloth_def def;
    must(call::cloth_def_init(&def, sizeof def));
    def.garment = scene.sheet(7), def.settings.sleep_speed = 0.01f;
    std::vector<float> x(3 * 49);
    for (std::size_t i = 0; i < 49; ++i) {
      x[3 * i] = distance + static_cast<float>(i % 7) / 8, x[3 * i + 1] = 0.0f;
      x[3 * i + 2] = distance + static_cast<float>(i / 7) / 8;
    }
    def.positions = x.data();
    pleat_cloth cloth{};
    must(call::cloth_create(scene, &def, &cloth));
    scene.step(1800);
    EXPECT_EQ(scene.stats().sleeping, 1u) << distance;
    float low[3], high[3];
    must(call::cloth_bounds(scene, cloth, low, high));
    EXPECT_LT(low[1], -0.5f) << "it hangs, " << distance;
  }
}

}  // namespace
}  // namespace pleat
