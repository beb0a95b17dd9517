#ifdef PLEAT_WITH_COLLISION
#include <algorithm>
#include <cmath>
#include <random>

#include "components/wide.h"
#include "engine/cloth_tick.h"
#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

pleat_cloth_settings in_layer(std::uint32_t layer) {
  pleat_cloth_settings s = Scene::default_settings();
  s.layer = layer;
  s.friction = 0.5f;
  return s;
}

pleat_contact_report report(Scene& scene, pleat_cloth cloth) {
  pleat_contact_report r{};
  r.size = sizeof r;
  must(call::cloth_contact_report(scene, cloth, &r));
  return r;
}

/// The cloth as it is, turned about the y axis and put somewhere else.
void place(Scene& scene, pleat_cloth cloth, float x, float y, float z, float turn) {
  std::vector<float> at = scene.particles(cloth);
  at.resize(at.size() / 2);
  for (std::size_t i = 0; i < at.size(); i += 3) {
    const float px = at[i], pz = at[i + 2];
    at[i] = std::cos(turn) * px + std::sin(turn) * pz + x;
    at[i + 1] += y;
    at[i + 2] = std::cos(turn) * pz - std::sin(turn) * px + z;
  }
  must(call::cloth_write_particles(scene, cloth, at.data(), nullptr, static_cast<std::uint32_t>(at.size() / 3)));
}

TEST(Layers, LeftOutUnlessAskedFor) {
  Scene scene;
  scene.cloth(scene.sheet(6));
  scene.step(2);
  EXPECT_TRUE(scene.explain("layer_candidates").ends_with("left out: layer is 0"));
  EXPECT_TRUE(scene.explain("layer_detection").ends_with("left out: layer is 0"));
  EXPECT_EQ(scene.inside().layers.begin.size() + scene.inside().layers.pairs.size(), 0u);
  EXPECT_EQ(scene.inside().workers[0].contacts.size(), 0u);
  Scene inner;
  inner.cloth(inner.sheet(6), in_layer(1));
  EXPECT_TRUE(inner.explain("layer_detection").ends_with("left out: the innermost layer"));
  inner.cloth(inner.sheet(6), in_layer(2));
  EXPECT_TRUE(inner.explain("layer_detection").starts_with("layer_detection"));
  EXPECT_NE(inner.explain("layer_detection").find("run for 1 of 2 cloths"), std::string::npos);
  EXPECT_NE(inner.explain("collision_response").find("run for 1 of 2 cloths"), std::string::npos);
}

TEST(Layers, PropertyASheetDroppedOnAnotherNeverCrossesIt) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> aside(-0.4f, 0.4f), turn(-3.0f, 3.0f);
  for (int trial = 0; trial < 6; ++trial) {
    Scene scene;
    const pleat_garment garment = scene.sheet(9);
    scene.sphere(0, -0.35f, 0, 0.3f);
    // The upper one is made first: the layers, not the order of making, say who runs first.
    const pleat_cloth upper = scene.cloth(garment, in_layer(2)), lower = scene.cloth(garment, in_layer(1));
    place(scene, upper, aside(random), 0.05f, aside(random), turn(random));
    std::uint64_t crossings = 0, contacts = 0;
    for (int tick = 0; tick < 120; ++tick) {
      scene.step();
      const pleat_contact_report r = report(scene, upper);
      crossings += r.layer_crossings;
      contacts += r.particle_contacts + r.face_contacts;
    }
    EXPECT_EQ(crossings, 0u) << trial;
    EXPECT_GT(contacts, 100u) << trial;
    EXPECT_EQ(report(scene, lower).layer_crossings, 0u);  // nothing is below it
    EXPECT_EQ(scene.stats().contacts_dropped, 0u);
    EXPECT_EQ(scene.stats().nonfinite_restored, 0u);
  }
}

TEST(Layers, ThoseBelowDoNotFeelThoseAbove) {
  Scene both, alone;
  const pleat_garment garment = both.sheet(8);
  const pleat_cloth upper = both.cloth(garment, in_layer(3)), lower = both.cloth(garment, in_layer(1));
  const pleat_cloth same = alone.cloth(alone.sheet(8), in_layer(1));
  place(both, upper, 0.1f, 0.02f, 0.1f, 0.3f);
  both.step(40), alone.step(40);
  EXPECT_GT(report(both, upper).face_contacts, 0u);
  EXPECT_TRUE(same_bits(both.particles(lower), alone.particles(same)));
}

TEST(Layers, OfOneLayerOrOfNoneDoNotMeet) {
  for (const std::uint32_t layer : {0u, 1u, 2u}) {
    Scene both, alone;
    const pleat_garment garment = both.sheet(8);
    both.cloth(garment, in_layer(layer));
    const pleat_cloth second = both.cloth(garment, in_layer(layer));
    const pleat_cloth same = alone.cloth(alone.sheet(8), in_layer(layer));
    both.step(20), alone.step(20);
    EXPECT_TRUE(same_bits(both.particles(second), alone.particles(same))) << layer;
  }
}

TEST(Layers, AreDeterministicAndAllocateNothingInATick) {
  std::vector<float> first;
  for (int run = 0; run < 2; ++run) {
    Scene scene;
    const pleat_garment garment = scene.sheet(9);
    const pleat_cloth upper = scene.cloth(garment, in_layer(2));
    scene.cloth(garment, in_layer(1));
    place(scene, upper, 0.1f, 0.03f, 0.1f, 0.4f);
    scene.step(2);
    const std::uint64_t before = scene.stats().allocations;
    scene.step(60);
    EXPECT_EQ(scene.stats().allocations, before);
    if (run == 0) first = scene.particles(upper);
    EXPECT_TRUE(same_bits(first, scene.particles(upper)));
  }
}

TEST(Layers, SurviveComingAndGoingOfCloths) {
  Scene scene;
  const pleat_garment garment = scene.sheet(8);
  const pleat_cloth other = scene.cloth(garment), lower = scene.cloth(garment, in_layer(1)),
                    upper = scene.cloth(garment, in_layer(2));
  place(scene, upper, 0.1f, 0.02f, 0.1f, 0.3f);
  Scene alone;
  const pleat_garment same = alone.sheet(8);
  alone.cloth(same, in_layer(1));
  const pleat_cloth same_upper = alone.cloth(same, in_layer(2));
  place(alone, same_upper, 0.1f, 0.02f, 0.1f, 0.3f);
  scene.step(10), alone.step(10);
  EXPECT_TRUE(same_bits(scene.particles(upper), alone.particles(same_upper)));
  must(call::cloth_destroy(scene, other));
  scene.step(10), alone.step(10);
  EXPECT_EQ(report(scene, upper).layer_crossings, 0u);
  must(call::cloth_destroy(scene, lower));
  scene.step();
  const pleat_contact_report none = report(scene, upper);
  EXPECT_EQ(none.particle_contacts + none.face_contacts, 0u);
  scene.cloth(garment, in_layer(1));
  scene.step(10);
  const pleat_contact_report again = report(scene, upper);
  EXPECT_GT(again.particle_contacts + again.face_contacts, 0u);
  EXPECT_EQ(scene.stats().nonfinite_restored, 0u);
}

/// Where the last cloth was when it last looked for pairs.
std::vector<Vec3> sought_at(Scene& scene) {
  const World& world = scene.inside();
  const ClothRecord& last = world.clothes.back();
  std::vector<Vec3> at;
  for (std::uint32_t i = 0; i < last.garment().particle_count; ++i) {
    at.push_back(world.layers.sought_at.view()[last.particle_begin + i]);
  }
  return at;
}

TEST(Layers, AtRestLookForNothing) {
  Scene scene;
  const pleat_garment garment = scene.sheet(9);
  scene.sphere(0, -0.35f, 0, 0.3f);
  const pleat_cloth lower = scene.cloth(garment, in_layer(1));
  place(scene, scene.cloth(garment, in_layer(2)), 0.1f, 0.03f, 0.1f, 0.4f);
  scene.step(300);
  const std::vector<Vec3> before = sought_at(scene);
  scene.step(20);
  EXPECT_EQ(sought_at(scene), before);
  place(scene, lower, 0, 0, 0, 0);  // where it is: what the upper one knows of it is forgotten
  scene.step();
  EXPECT_NE(sought_at(scene), before);
  EXPECT_GT(scene.inside().clothes.back().layer_pair_count, 100u);
}

TEST(Layers, GoOnFromASavedStateBitByBit) {
  Scene scene;
  const pleat_garment garment = scene.sheet(9);
  scene.sphere(0, -0.35f, 0, 0.3f);
  scene.cloth(garment, in_layer(1));
  const pleat_cloth upper = scene.cloth(garment, in_layer(2));
  place(scene, upper, 0.1f, 0.03f, 0.1f, 0.4f);
  for (const int tick : {20, 60, 200}) {
    scene.step(tick);
    const Bytes state = scene.saved();
    scene.step(40);
    const std::vector<float> expected = scene.particles(upper);
    const std::vector<Vec3> expected_sought_at = sought_at(scene);
    scene.step(15);  // pairs are others then
    must(scene.load(state));
    scene.step(40);
    EXPECT_TRUE(same_bits(scene.particles(upper), expected)) << tick;
    EXPECT_EQ(sought_at(scene), expected_sought_at) << tick;
  }
}

TEST(Layers, PairsThatFoundNoRoomGetThatOfAClothThatGoes) {
  Scene scene;
  const pleat_garment fine = scene.sheet(16);
  const pleat_cloth lowest = scene.cloth(fine, in_layer(1)), lower = scene.cloth(fine, in_layer(1));
  place(scene, lower, 0, 0.005f, 0, 0);
  const pleat_cloth upper = scene.cloth(scene.sheet(6), in_layer(2));
  place(scene, upper, 0, 0.02f, 0, 0);
  scene.step(20);
  const auto pairs = [&] { return scene.inside().clothes.back().layer_pair_count; };
  const std::uint32_t room = SelfColumns::kPairsPerParticle * scene.info(upper).particles;
  ASSERT_EQ(pairs(), room);
  for (int tick = 0; tick < 5; ++tick) {
    scene.step();
    EXPECT_GT(report(scene, upper).contacts_dropped, 0u) << "in each tick";
  }
  must(call::cloth_destroy(scene, lowest));
  const std::uint32_t left = pairs();
  ASSERT_LT(left, room);
  scene.step();
  EXPECT_GT(pairs(), left);
}

TEST(Layers, GiveTheSameBitsWithAnyVectors) {
  std::vector<float> first;
  for (const VectorSet vectors : kVectorSets) {
    vector_limit = vectors;
    Scene scene;
    const pleat_garment garment = scene.sheet(9);
    scene.sphere(0, -0.35f, 0, 0.3f);
    scene.cloth(garment, in_layer(1));
    pleat_cloth_settings settings = in_layer(2);
    settings.self_distance = 0.02f;
    const pleat_cloth upper = scene.cloth(garment, settings);
    place(scene, upper, 0.1f, 0.03f, 0.1f, 0.4f);
    scene.step(80);
    vector_limit = VectorSet::kAvx512;
    EXPECT_GT(report(scene, upper).face_contacts, 0u);
    if (first.empty()) first = scene.particles(upper);
    EXPECT_TRUE(same_bits(first, scene.particles(upper))) << static_cast<int>(vectors);
  }
}

/// Of the last cloth's pairs with the one at `position`, those whose side is known.
std::size_t known_sides(Scene& scene, std::uint32_t position) {
  const World& world = scene.inside();
  const ClothRecord& last = world.clothes.back();
  const NearPair* begin = world.layers.pairs.data() + SelfColumns::kPairsPerParticle * last.particle_begin;
  if (last.layer_pair_count == kNone) return 0;
  return static_cast<std::size_t>(std::count_if(begin, begin + last.layer_pair_count, [&](const NearPair& pair) {
    return pair.cloth == position && pair.side != 0.0f;
  }));
}

/// As a tick does.
void begin_frame(Scene& scene, std::size_t position) {
  World& world = scene.inside();
  ClothTick t(world, world.workers[0], world.clothes[position]);
  t.frame_dt = 1.0f / 60;
  run_phase(t, Phase::kFrameBegin);
}

TEST(Layers, WhatLeavesItsPlaceIsForgottenAndNothingElse) {
  const float here[3] = {0, 0, 0}, far[3] = {0, -20, 0};
  enum Change { kGoes, kIsPlaced, kIsCarried, kChangesLayer };
  for (const Change change : {kGoes, kIsPlaced, kIsCarried, kChangesLayer}) {
    for (int which = 0; which < 3; ++which) {
      Scene scene;
      const pleat_garment garment = scene.sheet(8);
      const pleat_cloth below[] = {scene.cloth(garment), scene.cloth(garment, in_layer(1)),
                                   scene.cloth(garment, in_layer(2))};
      const pleat_cloth upper = scene.cloth(garment, in_layer(3));
      place(scene, below[2], 0.1f, 0.01f, 0.1f, 0.3f);
      place(scene, upper, -0.1f, 0.02f, 0.1f, 0.5f);
      scene.step(10);
      const std::size_t known[] = {known_sides(scene, 0), known_sides(scene, 1), known_sides(scene, 2)};
      ASSERT_GT(known[1], 100u);
      ASSERT_GT(known[2], 100u);
      const pleat_cloth cloth = below[which];
      pleat_cloth_settings settings = scene.settings(cloth);
      settings.layer = 4;
      switch (change) {
        case kGoes:
          must(call::cloth_destroy(scene, cloth));
          break;
        case kIsPlaced:
          place(scene, cloth, 0, -20, 0, 0);
          break;
        case kIsCarried:
          must(call::cloth_teleport(scene, cloth, here, far, nullptr));
          begin_frame(scene, static_cast<std::size_t>(which));
          break;
        case kChangesLayer:
          must(call::cloth_set(scene, cloth, &settings));
          break;
      }
      for (int k = 1; k < 3; ++k) {
        const int now = change == kGoes && k > which ? k - 1 : k;
        if (change == kGoes && k == which) continue;  // its number is another one's
        EXPECT_EQ(known_sides(scene, static_cast<std::uint32_t>(now)), k == which ? 0 : known[k])
            << change << which << k;
      }
      EXPECT_EQ(known_sides(scene, 0), change == kGoes && which == 0 ? known[1] : 0);
    }
  }
}

}  // namespace
}  // namespace pleat
#endif
