#include "engine/world.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// Cloths of several garments and settings in one world; some touch a ball.
class Batch {
 public:
  Scene scene;
  std::vector<pleat_garment> garments;

  Batch() {
    for (const std::uint32_t n : {4u, 7u, 5u}) garments.push_back(scene.sheet(n));
#ifdef PLEAT_WITH_COLLISION
    scene.sphere(0, -0.25f, 0, 0.2f);
#endif
  }
  pleat_cloth add(std::size_t kind) { return scene.cloth(garments[kind % 3], settings(kind)); }

  static pleat_cloth_settings settings(std::size_t kind) {
    pleat_cloth_settings s = Scene::default_settings();
    s.level = static_cast<std::uint32_t>(kind % 4);
    s.integrator = kind % 5 == 4 ? PLEAT_INTEGRATOR_RUNGE_KUTTA_4 : PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
#ifdef PLEAT_WITH_SMOOTHING
    s.surface = static_cast<std::uint32_t>((kind + 3) % 4);
#endif
    return s;
  }
};

TEST(World, AddedMassWeighsWhereThereIsCloth) {
  Scene scene;
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 0, -1, 5, 5, 5}, masses[] = {0.5f, 0, 0, 0.5f};
  const std::uint32_t triangle[] = {0, 1, 2};
  pleat_garment_def def;
  must(call::garment_def_init(&def, sizeof def));
  def.positions = positions, def.vertex_count = 4;
  def.triangles = triangle, def.triangle_count = 1;
  def.added_mass = masses;
  pleat_garment garment{};
  must(call::garment_create(scene, &def, nullptr, &garment));
  scene.cloth(garment);
  const ParticleColumns& p = scene.inside().particles;
  const float own = Scene::default_settings().density * 0.5f / 3.0f;
  EXPECT_FLOAT_EQ(p.mass[0], own + 0.5f);
  EXPECT_FLOAT_EQ(p.mass[1], own);
  EXPECT_FLOAT_EQ(p.inverse_mass[0], 1.0f / (own + 0.5f));
  EXPECT_EQ(p.mass[3], 0.0f);  // no triangle uses it: it hangs where it is
  EXPECT_EQ(p.inverse_mass[3], 0.0f);
}

/// The ranges of all cloths lie one after the other without a gap.
void expect_compact(Scene& scene) {
  World& world = scene.inside();
  std::uint32_t particles = 0, pins = 0, edges = 0;
  std::vector<std::pair<std::uint32_t, std::size_t>> drawn;
  for (const ClothRecord& cloth : world.clothes) {
    EXPECT_EQ(cloth.particle_begin, particles);
    EXPECT_EQ(cloth.pin_begin, pins);
    EXPECT_EQ(cloth.edge_begin, edges);
    particles += static_cast<std::uint32_t>(padded(cloth.garment().particle_count));
    pins += static_cast<std::uint32_t>(padded(cloth.garment().pins.size()));
    edges += static_cast<std::uint32_t>(padded(cloth.garment().edge_count));
    if (cloth.pattern() != nullptr) drawn.emplace_back(cloth.drawn_begin, padded(cloth.pattern()->vertex_count));
  }
  EXPECT_EQ(world.particles.position.size(), particles);
  EXPECT_EQ(world.particles.mass.size(), particles);
  EXPECT_EQ(world.pin_next.size(), pins);
  EXPECT_TRUE(world.surface.normal.size() == 0 || world.surface.normal.size() == particles);
  EXPECT_TRUE(world.surface.fold.size() == 0 || world.surface.fold.size() == edges);
  EXPECT_TRUE(world.runge_kutta.velocity_slope.size() == 0 || world.runge_kutta.velocity_slope.size() == particles);
  std::sort(drawn.begin(), drawn.end());
  std::size_t end = 0;
  for (const auto& [begin, count] : drawn) {
    EXPECT_EQ(begin, end);
    end += count;
  }
  EXPECT_EQ(world.drawn.position.size(), end);
  EXPECT_EQ(world.drawn.normal.size(), end);
}

TEST(World, DestroyingInAnyOrderKeepsTheOthersBitForBit) {
  Batch batch;
  std::vector<std::pair<pleat_cloth, std::size_t>> live;
  std::uint32_t seed = 3;
  for (std::size_t step = 0; step < 60; ++step) {
    seed = seed * 1664525u + 1013904223u;
    std::vector<std::vector<float>> particles, vertices;
    for (const auto& [cloth, kind] : live) {
      particles.push_back(batch.scene.particles(cloth));
      vertices.push_back(batch.scene.vertices(cloth));
    }
    if (live.size() < 3 || (seed >> 20) % 2 == 0) {
      live.emplace_back(batch.add(step), step);
    } else {
      const std::size_t gone = (seed >> 8) % live.size();
      must(call::cloth_destroy(batch.scene, live[gone].first));
      live.erase(live.begin() + static_cast<std::ptrdiff_t>(gone));
      particles.erase(particles.begin() + static_cast<std::ptrdiff_t>(gone));
      vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(gone));
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
      EXPECT_TRUE(same_bits(batch.scene.particles(live[i].first), particles[i])) << step;
      EXPECT_TRUE(same_bits(batch.scene.vertices(live[i].first), vertices[i])) << step;
    }
    expect_compact(batch.scene);
    batch.scene.step();
  }
}

TEST(World, ChangingALevelMovesDrawnRangesAndNothingElse) {
  Batch batch;
  std::vector<pleat_cloth> cloths;
  for (std::size_t kind = 0; kind < 5; ++kind) cloths.push_back(batch.add(kind));
  batch.scene.step(5);
  for (std::uint32_t step = 0; step < 20; ++step) {
    const std::size_t changed = (step * 3 + 1) % cloths.size();
    std::vector<std::vector<float>> particles, vertices;
    for (const pleat_cloth cloth : cloths) {
      particles.push_back(batch.scene.particles(cloth));
      vertices.push_back(batch.scene.vertices(cloth));
    }
    pleat_cloth_settings s = batch.scene.settings(cloths[changed]);
    s.level = (step * 5 + 2) % 9;
    must(call::cloth_set(batch.scene, cloths[changed], &s));
    expect_compact(batch.scene);
    for (std::size_t i = 0; i < cloths.size(); ++i) {
      EXPECT_TRUE(same_bits(batch.scene.particles(cloths[i]), particles[i]));
      EXPECT_TRUE(i == changed || same_bits(batch.scene.vertices(cloths[i]), vertices[i])) << i;
    }
  }
}

TEST(World, ClothAloneEqualsTheSameClothInABatchBitForBit) {
  constexpr int kTicks = 40;
  Batch batch;
  std::vector<pleat_cloth> cloths;
  for (std::size_t kind = 0; kind < 12; ++kind) cloths.push_back(batch.add(kind));
  batch.scene.step(kTicks);
  for (std::size_t kind = 0; kind < 12; ++kind) {
    Batch alone;
    const pleat_cloth cloth = alone.add(kind);
    alone.scene.step(kTicks);
    EXPECT_TRUE(same_bits(alone.scene.particles(cloth), batch.scene.particles(cloths[kind]))) << kind;
    EXPECT_TRUE(same_bits(alone.scene.vertices(cloth), batch.scene.vertices(cloths[kind]))) << kind;
  }
}

TEST(World, SurfaceIsDrawnBeforeTheFirstTick) {
  Scene scene;
  const pleat_garment sheet = scene.sheet(4);
  const pleat_cloth cloth = scene.cloth(sheet);
  const auto expect_sane = [&] {
    const std::vector<float> v = scene.vertices(cloth);
    for (std::size_t i = 0; i < v.size(); i += 8) {
      EXPECT_LE(std::abs(v[i]), 0.5f + 1e-6f);
      EXPECT_EQ(v[i + 1], 0.0f);
      EXPECT_NEAR(v[i + 4], 1.0f, 1e-5f);  // the normal is up
    }
    EXPECT_NE(v[0], v[8]);
  };
  expect_sane();
  for (std::uint32_t level = 0; level <= PLEAT_LEVEL_MAX; ++level) {
    pleat_cloth_settings s = scene.settings(cloth);
    s.level = level;
#ifdef PLEAT_WITH_SMOOTHING
    s.surface = level % 4;
#endif
    must(call::cloth_set(scene, cloth, &s));
    expect_sane();
  }
}

TEST(World, SurfaceFollowsParticlesThatAreWritten) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(3));
  std::vector<float> positions = scene.particles(cloth);
  positions.resize(27);
  for (std::size_t i = 1; i < 27; i += 3) positions[i] += 5.0f;
  must(call::cloth_write_particles(scene, cloth, positions.data(), nullptr, 9));
  for (std::size_t i = 1; i < scene.vertices(cloth).size(); i += 8) EXPECT_FLOAT_EQ(scene.vertices(cloth)[i], 5.0f);
  scene.step();
  EXPECT_NEAR(scene.particles(cloth)[1], 5.0f, 1e-6f);  // the pin came along
}

TEST(World, GarmentIsSharedAndOutlivesItsClothsOnly) {
  Scene scene;
  const pleat_garment sheet = scene.sheet(3);
  const pleat_cloth a = scene.cloth(sheet), b = scene.cloth(sheet);
  must(call::cloth_destroy(scene, a));
  EXPECT_EQ(call::garment_destroy(scene, sheet), pleat_result{PLEAT_ERROR_ARGUMENT});
  must(call::cloth_destroy(scene, b));
  must(call::garment_destroy(scene, sheet));
  EXPECT_TRUE(scene.inside().garments.empty());
}

#ifdef PLEAT_WITH_COLLISION
TEST(World, CollidersCompactAndKeepTheirHandles) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(5));
  const pleat_collider a = scene.sphere(0, -9, 0, 0.1f), b = scene.sphere(0, -0.3f, 0, 0.2f);
  must(call::collider_destroy(scene, a));
  const float at[3] = {0, -0.35f, 0};
  must(call::collider_move_capsule(scene, b, at, at));
  EXPECT_EQ(call::collider_move_capsule(scene, a, at, at), pleat_result{PLEAT_ERROR_HANDLE});
  scene.step(30);
  EXPECT_GT(scene.stats().particle_contacts + scene.stats().face_contacts, 0u);
  EXPECT_FLOAT_EQ(scene.inside().capsules.previous_a.y[0], -0.35f);
  must(call::collider_set_enabled(scene, b, 0));
  scene.step(1);
  EXPECT_EQ(scene.stats().particle_contacts + scene.stats().face_contacts, 0u);
  (void)cloth;
}
#endif

}  // namespace
}  // namespace pleat
