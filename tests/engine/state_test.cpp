// A world whose state is loaded goes on with the same bits.
#if defined(PLEAT_WITH_COLLISION) && defined(PLEAT_WITH_SMOOTHING)
#include <cmath>
#include <limits>

#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// Far from the origin and in gusts: a cloth over a ball, one above it in a higher layer, one that touches itself on a
/// box that turns over a plane and a mesh, and one that the integrators' optional columns are for.
struct Stage : Scene {
  static constexpr float kAt[3] = {512, 64, -1024};
  std::vector<pleat_cloth> cloths;
  pleat_collider ball, box, ground, mesh;

  static pleat_world_def gusty() {
    pleat_world_def def = default_def();
    def.wind[0] = 2.0f, def.gust = 1.5f;
    def.log = [](std::uint32_t, const char*, void*) {};
    return def;
  }
  Stage() : Scene(gusty()) {
    const pleat_garment coarse = sheet(5), fine = sheet(8);
    ball = body(PLEAT_COLLIDER_SPHERE, 0, -0.3f);
    box = body(PLEAT_COLLIDER_BOX, 2, -0.3f);
    ground = body(PLEAT_COLLIDER_PLANE, 0, -0.6f);
    mesh = body(PLEAT_COLLIDER_MESH, 2.25f, -0.4f);
    pleat_cloth_settings s = default_settings();
    s.drag_coefficient = 1.0f, s.layer = 1;
    add(fine, s, 0, 0);
    s.layer = 2, s.tangents = 1, s.level = 2;
    add(fine, s, 0, 0.06f);
    s.layer = 0, s.self_distance = 0.02f;
    add(fine, s, 2, 0);
    s.integrator = PLEAT_INTEGRATOR_RUNGE_KUTTA_4, s.surface = PLEAT_SURFACE_PAPER, s.sleep_speed = 0.05f;
    s.drag_coefficient = 0.0f, s.self_distance = 0.0f;
    add(coarse, s, 4, 0);
  }
  void add(pleat_garment garment, const pleat_cloth_settings& settings, float x, float y) {
    const pleat_cloth made = cloth(garment, settings);
    std::vector<float> at = particles(made);
    at.resize(at.size() / 2);
    for (std::size_t i = 0; i < at.size(); i += 3) at[i] += kAt[0] + x, at[i + 1] += kAt[1] + y, at[i + 2] += kAt[2];
    must(call::cloth_write_particles(*this, made, at.data(), nullptr, static_cast<std::uint32_t>(at.size() / 3)));
    cloths.push_back(made);
  }
  pleat_collider body(std::uint32_t shape, float x, float y) {
    pleat_collider_def def;
    must(call::collider_def_init(&def, sizeof def));
    def.shape = shape, def.radius = 0.2f;
    const float at[3] = {kAt[0] + x, kAt[1] + y, kAt[2]};
    std::copy_n(at, 3, def.a), std::copy_n(at, 3, def.b), std::copy_n(at, 3, def.position);
    std::fill_n(def.half_extents, 3, 0.15f);
    constexpr std::uint32_t kFaces[] = {0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3};
    const std::vector<float> corners = pyramid(0);
    def.positions = corners.data(), def.vertex_count = 4, def.triangles = kFaces, def.triangle_count = 4;
    pleat_collider made{};
    must(call::collider_create(*this, &def, &made));
    return made;
  }
  static std::vector<float> pyramid(float up) {
    std::vector<float> corners{-0.3f, -0.2f, -0.3f, 0.3f, -0.2f, -0.3f, 0, -0.2f, 0.3f, 0, 0.15f, 0};
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      corners[i] += kAt[0] + 2.3f, corners[i + 1] += kAt[1] - 0.4f + up, corners[i + 2] += kAt[2];
    }
    return corners;
  }
  /// Moves everything to where it is at the end of a tick.
  void pose(int tick) {
    const float t = static_cast<float>(tick) / 60, swing = 0.2f * std::sin(4.0f * t);
    for (std::size_t k = 0; k < cloths.size(); ++k) {
      if (k == 3 && tick > 30) continue;  // it comes to rest
      const float x = kAt[0] + (k < 2 ? 0.0f : k == 2 ? 2.0f : 4.0f) + swing, y = kAt[1] + (k == 1 ? 0.06f : 0.0f);
      const float z = kAt[2] - 0.5f, pins[] = {x - 0.5f, y, z, x + 0.5f - 0.3f * std::abs(swing), y, z};
      must(call::cloth_move_pins(*this, cloths[k], pins, 0, 2));
    }
    const float at[3] = {kAt[0] - swing, kAt[1] - 0.3f, kAt[2] + swing};
    must(call::collider_move_capsule(*this, ball, at, at));
    const float place[3] = {kAt[0] + 2, kAt[1] - 0.3f + 0.5f * swing, kAt[2]};
    const float turn[4] = {0, std::sin(t), 0, std::cos(t)};
    must(call::collider_move_rigid(*this, box, place, turn));
    must(call::collider_move_mesh(*this, mesh, pyramid(0.3f * swing).data(), 0, 4));
    if (tick == 75) must(call::collider_set_enabled(*this, ball, 0));
    if (tick == 50) must(call::cloth_set_visible(*this, cloths[1], 0));
    if (tick == 65) must(call::cloth_set_visible(*this, cloths[1], 1));
    must(call::world_keep_budget(*this, 0.2f, 0.1f + 0.2f * std::abs(swing)));
  }
  /// Ticks from .. to - 1. Returns what can be read after each.
  std::vector<float> play(int from, int to) {
    std::vector<float> all;
    for (int tick = from; tick < to; ++tick) {
      pose(tick);
      step();
      const std::vector<float> now = seen();
      all.insert(all.end(), now.begin(), now.end());
    }
    return all;
  }
  std::vector<float> seen() {
    std::vector<float> all;
    for (const pleat_cloth& cloth : cloths) {
      const std::vector<float> x = particles(cloth);
      all.insert(all.end(), x.begin(), x.end());
      if (inside().clothes[static_cast<std::size_t>(&cloth - cloths.data())].visible) {
        const std::vector<float> drawn = vertices(cloth);
        all.insert(all.end(), drawn.begin(), drawn.end());
      }
      pleat_contact_report report{};
      report.size = sizeof report;
      must(call::cloth_contact_report(*this, cloth, &report));
      all.insert(all.end(), {report.particle_depth, report.drawn_depth, static_cast<float>(report.particle_contacts),
                             static_cast<float>(info(cloth).substeps)});
    }
    return all;
  }
};

TEST(State, PropertyAWorldGoesOnWithTheSameBits) {
  for (const int saved_at : {1, 57, 90}) {
    Stage stage, other;
    stage.play(0, saved_at);
    stage.pose(saved_at);  // what is due at the next tick is part of it
    const Bytes state = stage.saved();
    const std::vector<float> seen = stage.seen(), first = stage.play(saved_at, saved_at + 60);
    ASSERT_EQ(stage.load(state), pleat_result{PLEAT_OK});
    EXPECT_EQ(stage.saved(), state);
    EXPECT_TRUE(same_bits(stage.seen(), seen)) << "what was drawn";
    EXPECT_TRUE(same_bits(stage.play(saved_at, saved_at + 60), first)) << "in the same world, saved at " << saved_at;
    other.play(17, 40);
    ASSERT_EQ(other.load(state), pleat_result{PLEAT_OK});
    EXPECT_EQ(other.saved(), state);
    EXPECT_TRUE(same_bits(other.seen(), seen));
    EXPECT_TRUE(same_bits(other.play(saved_at, saved_at + 60), first)) << "in another world, saved at " << saved_at;
  }
}

TEST(State, TheSceneUsesWhatIsSaved) {
  Stage stage;
  stage.play(0, 60);
  const World& w = stage.inside();
  EXPECT_NE(w.clothes[1].layer_pair_count, 0u);
  EXPECT_NE(w.clothes[2].self_pair_count, kNone);
  EXPECT_GT(w.clothes[0].contacts.particle, 0u);
  EXPECT_GT(w.clothes[2].contacts.particle + w.clothes[2].contacts.face, 0u);
  EXPECT_NE(w.clothes[0].origin, Vec3{});
  EXPECT_FALSE(w.clothes[1].visible);
}

TEST(State, WhatWasMovedForTheNextTickStandsStillAfterIt) {
  Stage stage, fresh;
  stage.play(0, 20);
  stage.pose(40);
  const Bytes state = stage.saved();
  const auto five_ticks = [](Stage& of) {
    of.step(5);
    return of.seen();
  };
  const std::vector<float> first = five_ticks(stage);
  ASSERT_EQ(fresh.load(state), pleat_result{PLEAT_OK});
  EXPECT_TRUE(same_bits(five_ticks(fresh), first));
  const MeshCollider &box = fresh.inside().meshes[0].mesh, &mesh = fresh.inside().meshes[1].mesh;
  EXPECT_EQ(box.previous_pose, box.next_pose);
  EXPECT_EQ(mesh.previous.y[3], mesh.next.y[3]);
}

TEST(State, SleepStartsJumpsAndDetailGoOnWhereTheyWere) {
  Stage stage, other;
  ClothRecord& cloth = stage.inside().clothes[2];
  cloth.calm = 0.3f, cloth.settling = 0.1f, cloth.pin_velocity = {1, 2, 3}, cloth.importance = 4.0f;
  cloth.given_up = 2, cloth.fold_share = 0.25f, cloth.substep_share = 0.75f, stage.inside().cost = 0.5f;
  stage.inside().work = 3.0f, stage.inside().scarcity = 4e31f, stage.inside().turn = 5;
  cloth.young = 0.5f, cloth.travelled = 0.25f, cloth.carried = true;
  ASSERT_EQ(other.load(stage.saved()), pleat_result{PLEAT_OK});
  const ClothRecord& there = other.inside().clothes[2];
  EXPECT_EQ(there.calm, 0.3f);
  EXPECT_EQ(there.settling, 0.1f);
  EXPECT_EQ(there.pin_velocity, (Vec3{1, 2, 3}));
  EXPECT_EQ(there.importance, 4.0f);
  EXPECT_EQ(there.given_up, 2u);
  EXPECT_EQ(there.fold_share, 0.25f);
  EXPECT_EQ(there.substep_share, 0.75f);
  EXPECT_EQ(there.young, 0.5f);
  EXPECT_EQ(there.travelled, 0.25f);
  EXPECT_TRUE(there.carried);
  EXPECT_EQ(other.inside().cost, 0.5f);
  EXPECT_EQ(other.inside().work, 3.0f);
  EXPECT_EQ(other.inside().scarcity, 4e31f);
  EXPECT_EQ(other.inside().turn, 5u);
  EXPECT_TRUE(other.explain("fold_fade").find("run for") != std::string::npos) << "the plan follows";
}

TEST(State, ThereIsNoneWithinATick) {
  struct Caller {
    pleat_world* world = nullptr;
    std::uint32_t tried = 0, refused = 0;
  } caller;
  pleat_world_def def = Scene::default_def();
  def.log = [](std::uint32_t, const char*, void*) {};
  def.stage = [](const char*, int, void* user) {
    Caller& c = *static_cast<Caller*>(user);
    if (c.world == nullptr) return;
    std::uint64_t bytes = 0;
    char state[8];
    for (const pleat_result result : {call::world_state_size(c.world, &bytes), call::world_save(c.world, state, 8),
                                      call::world_load(c.world, state, 8)}) {
      ++c.tried, c.refused += result == pleat_result{PLEAT_ERROR_ARGUMENT};
    }
  };
  def.stage_user = &caller;
  Scene scene(def);
  scene.cloth(scene.sheet(4));
  caller.world = scene;
  scene.step();
  EXPECT_GT(caller.tried, 0u);
  EXPECT_EQ(caller.refused, caller.tried);
}

/// Folds of another surface that was drawn before, of which nothing is left to see.
TEST(State, WhatIsOfNoConsequenceIsNotInIt) {
  Scene scene, other;
  pleat_cloth_settings s = Scene::default_settings();
  const pleat_cloth cloth = scene.cloth(scene.sheet(6), s);
  scene.step(20);
  s.surface = PLEAT_SURFACE_PN;
  must(call::cloth_set(scene, cloth, &s));
  const pleat_cloth copy = other.cloth(other.sheet(6), s);
  must(other.load(scene.saved()));
  s.surface = PLEAT_SURFACE_PAPER;
  must(call::cloth_set(scene, cloth, &s)), must(call::cloth_set(other, copy, &s));
  scene.step(), other.step();
  EXPECT_EQ(scene.saved(), other.saved());
}

TEST(State, PinsThatAreToldToStayAreSaved) {
  const float here[3] = {0, 0, 0}, there[3] = {0.5f, 0, 0}, pins[6] = {-0.5f, 0, -0.5f, 0.5f, 0, -0.5f};
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4));
  must(call::cloth_move_pins(scene, cloth, pins, 0, 2));
  must(call::cloth_teleport(scene, cloth, here, there, nullptr));
  const Bytes due = scene.saved();
  scene.step();
  const std::vector<float> after = scene.particles(cloth);
  must(call::cloth_teleport(scene, cloth, here, there, nullptr));  // now they come along
  scene.step();
  must(scene.load(due));
  scene.step();
  EXPECT_EQ(after[0], pins[0]);
  EXPECT_TRUE(same_bits(scene.particles(cloth), after));
}

TEST(State, AJumpThatIsDueIsSaved) {
  const float from[3] = {0, 0, 0}, to[3] = {3, 1, 2}, turn[4] = {0, 0.6f, 0, 0.8f};
  Scene scene, other;
  const pleat_cloth cloth = scene.cloth(scene.sheet(6)), same = other.cloth(other.sheet(6));
  scene.step(10);
  must(call::cloth_teleport(scene, cloth, from, to, turn));
  std::uint64_t bytes = 0;
  must(call::world_state_size(scene, &bytes));
  Bytes state(bytes);
  must(call::world_save(scene, state.data(), bytes));
  must(call::world_load(other, state.data(), bytes));
  scene.step(), other.step();
  EXPECT_TRUE(same_bits(scene.particles(cloth), other.particles(same)));
  EXPECT_EQ(other.stats().teleports, 1u);
}

TEST(State, SavingAllocatesNothing) {
  Stage stage;
  stage.play(0, 60);
  Bytes state = stage.saved();
  const std::uint64_t before = global_allocations();
  must(call::world_save(stage, state.data(), state.size()));
  EXPECT_EQ(global_allocations(), before);
}

TEST(State, BytesThatDoNotFitAreRefusedAndNothingChanges) {
  Stage stage, twin;
  stage.play(0, 30), twin.play(0, 30);
  const Bytes earlier = stage.saved();
  stage.play(30, 40), twin.play(30, 40);
  const Bytes now = stage.saved();
  const auto refused = [&](const Bytes& state) {
    EXPECT_EQ(stage.load(state), pleat_result{PLEAT_ERROR_ARGUMENT});
    EXPECT_EQ(stage.saved(), now);
  };
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, earlier.size() / 2, earlier.size() - 1}) {
    refused(Bytes(earlier.begin(), earlier.begin() + static_cast<std::ptrdiff_t>(size)));
  }
  Bytes state = earlier;
  state.push_back(0);
  refused(state);
  const std::size_t header = 4 + 4 + sizeof PLEAT_VERSION_STRING + 4 + 8 + 4 + 4 + 4 * 14 * 4 + 4 * 4 + 2 * 8;
  for (std::size_t bit = 0; bit < 8 * header; ++bit) {
    state = earlier;
    state[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
    EXPECT_EQ(stage.load(state), pleat_result{PLEAT_ERROR_ARGUMENT}) << "bit " << bit;
  }
  const float bad = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t at = header + 12; at + 4 <= earlier.size(); at += 4 * 97) {
    state = earlier;
    std::memcpy(state.data() + at, &bad, sizeof bad);
    // Counts of contacts alone hold any bits.
    if (stage.load(state) == pleat_result{PLEAT_OK}) must(stage.load(now));
    ASSERT_EQ(stage.saved(), now) << at;
  }
  EXPECT_TRUE(same_bits(stage.play(40, 60), twin.play(40, 60)));
}

TEST(State, NumbersThatNoTickLeavesBehindAreRefused) {
  Stage stage;
  float& velocity = stage.inside().particles.velocity.x[20];
  for (const float bad : {1e30f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    velocity = bad;
    const Bytes state = stage.saved();
    velocity = 0.0f;
    EXPECT_EQ(stage.load(state), pleat_result{PLEAT_ERROR_ARGUMENT});
    EXPECT_EQ(velocity, 0.0f);
  }
}

TEST(State, AnotherWorldIsToldFromThisOneByName) {
  std::vector<std::string> lines;
  pleat_world_def def = Scene::default_def();
  def.log = [](std::uint32_t, const char* line, void* user) {
    static_cast<std::vector<std::string>*>(user)->push_back(line);
  };
  def.log_user = &lines;
  Scene scene, other(def);
  scene.cloth(scene.sheet(6));
  std::uint64_t bytes = 0;
  must(call::world_state_size(scene, &bytes));
  Bytes state(bytes);
  must(call::world_save(scene, state.data(), bytes));
  const auto refused = [&](const char* field) {
    lines.clear();
    EXPECT_EQ(call::world_load(other, state.data(), bytes), pleat_result{PLEAT_ERROR_ARGUMENT});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find(field), std::string::npos) << lines[0];
  };
  refused("number of cloths is 1, here it is 0");
  const pleat_cloth wrong = other.cloth(other.sheet(5));
  refused("particle count of cloth 0 is 36, here it is 25");
  must(call::cloth_destroy(other, wrong));
  const pleat_cloth cloth = other.cloth(other.sheet(6));
  pleat_cloth_settings s = Scene::default_settings();
  s.level = 3;
  must(call::cloth_set(other, cloth, &s));
  refused("drawn vertex count of cloth 0");
  s.level = PLEAT_LEVEL_FAN, s.self_distance = 0.01f;
  must(call::cloth_set(other, cloth, &s));
  refused("use of self_distance by cloth 0");
  s.self_distance = 0.0f;
  must(call::cloth_set(other, cloth, &s));
  const pleat_collider ball = other.sphere(0, -5, 0, 0.1f);
  refused("number of colliders is 0, here it is 1");
  must(call::collider_destroy(other, ball));
  EXPECT_EQ(call::world_load(other, state.data(), bytes), pleat_result{PLEAT_OK});
}

}  // namespace
}  // namespace pleat
#endif
