// What holds for every tick: it allocates nothing, gives the same bits, and lets nothing out that is not finite.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "components/wide.h"
#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// Two kinds of cloth over a moving ball and a moving mesh body, everything switched on.
class Messy {
 public:
  explicit Messy(const pleat_world_def& def = Scene::default_def()) : scene(def) {
    const pleat_garment sheet = scene.sheet(9);
    pleat_cloth_settings s = Scene::default_settings();
    s.drag_coefficient = 1.28f;
    cloths.push_back(scene.cloth(sheet, s));
    s.integrator = PLEAT_INTEGRATOR_RUNGE_KUTTA_4;
#ifdef PLEAT_WITH_SMOOTHING
    s.surface = PLEAT_SURFACE_PAPER;
#endif
    s.level = 3;
    cloths.push_back(scene.cloth(sheet, s));
    const float wind[3] = {2, 1, 3};
    must(call::world_set_wind(scene, wind));
#ifdef PLEAT_WITH_COLLISION
    ball = scene.sphere(0, -0.25f, 0, 0.2f);
    pleat_collider_def def_mesh;
    must(call::collider_def_init(&def_mesh, sizeof def_mesh));
    def_mesh.shape = PLEAT_COLLIDER_MESH;
    def_mesh.positions = kTetrahedron[0];
    def_mesh.vertex_count = 4;
    def_mesh.triangles = kFaces;
    def_mesh.triangle_count = 4;
    must(call::collider_create(scene, &def_mesh, &body));
#endif
  }

  void tick() {
    const float t = static_cast<float>(++ticks) / 60.0f;
    for (const pleat_cloth cloth : cloths) {
      const float pins[2][3] = {{-0.5f + 0.1f * std::sin(5 * t), 0.1f * std::sin(7 * t), -0.5f}, {0.4f, 0, -0.5f}};
      must(call::cloth_move_pins(scene, cloth, pins[0], 0, 2));
    }
#ifdef PLEAT_WITH_COLLISION
    const float a[3] = {0.2f * std::sin(4 * t), -0.25f, 0.2f * std::cos(3 * t)}, b[3] = {a[0], a[1] - 0.3f, a[2]};
    must(call::collider_move_capsule(scene, ball, a, b));
    float moved[4][3];
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) moved[i][k] = kTetrahedron[i][k] + (k == 1 ? 0.1f * std::sin(6 * t) : 0.0f);
    }
    must(call::collider_move_mesh(scene, body, moved[0], 0, 4));
#endif
    scene.step();
  }

  std::vector<float> state() {
    std::vector<float> all;
    for (const pleat_cloth cloth : cloths) {
      for (const std::vector<float>& part : {scene.particles(cloth), scene.vertices(cloth)}) {
        all.insert(all.end(), part.begin(), part.end());
      }
    }
    return all;
  }

  Scene scene;
  std::vector<pleat_cloth> cloths;
  pleat_collider ball{}, body{};
  int ticks = 0;

 private:
  static constexpr float kTetrahedron[4][3] = {
      {-0.3f, -0.6f, -0.2f}, {0.1f, -0.6f, 0.4f}, {0.4f, -0.6f, -0.2f}, {0.1f, -0.2f, 0.1f}};
  static constexpr std::uint32_t kFaces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
};

void expect_finite(const std::vector<float>& values) {
  for (const float value : values) ASSERT_TRUE(std::isfinite(value));
}

TEST(Step, AllocatesNothingAfterWarmUp) {
  static std::uint64_t host_calls = 0;
  pleat_world_def def = Scene::default_def();
  def.allocate = [](size_t bytes, size_t alignment, void*) {
    ++host_calls;
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  };
  def.free = [](void* memory, size_t, size_t, void*) { std::free(memory); };
  Messy messy(def);
  messy.tick();
  messy.tick();
  const std::uint64_t host = host_calls, global = global_allocations(), counted = messy.scene.stats().allocations;
  ASSERT_GT(host, 0u);
  [[maybe_unused]] std::uint64_t contacts = 0;
  for (int i = 0; i < 60; ++i) {
    messy.tick();
    contacts += messy.scene.stats().particle_contacts;
  }
  EXPECT_EQ(host_calls, host);
  EXPECT_EQ(global_allocations(), global);
  EXPECT_EQ(messy.scene.stats().allocations, counted);
#ifdef PLEAT_WITH_COLLISION
  EXPECT_GT(contacts, 0u);
#endif
}

TEST(Step, ImplicitEulerTakesNothingFromTheHeapAfterWarmUp) {
  if (!heap_calls()) GTEST_SKIP() << "malloc is a sanitizer's, or not glibc's";
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  s.integrator = PLEAT_INTEGRATOR_IMPLICIT_EULER;
  s.stiffness = 1e4f;
  const std::uint64_t before = *heap_calls();
  scene.cloth(scene.sheet(24), s);
  EXPECT_GT(*heap_calls(), before);  // Eigen's matrix and factor
  scene.step(2);
  const std::uint64_t made = *heap_calls(), created = global_allocations();
  scene.step(60);
  EXPECT_EQ(*heap_calls(), made);
  EXPECT_EQ(global_allocations(), created);
}

TEST(Step, TwoWorldsGiveTheSameBits) {
  Messy a, b;
  for (int i = 0; i < 60; ++i) {
    a.tick();
    b.tick();
    ASSERT_TRUE(same_bits(a.state(), b.state())) << i;
  }
}

TEST(Step, EveryVectorSetGivesTheSameBits) {
  if (widest_vectors() == VectorSet::kBaseline) GTEST_SKIP() << "the processor has no AVX2";
  Messy by_set[std::size(kVectorSets)];
  for (int i = 0; i < 60; ++i) {
    for (std::size_t k = 0; k < std::size(kVectorSets); ++k) {
      vector_limit = kVectorSets[k];
      by_set[k].tick();
    }
    for (Messy& messy : by_set) ASSERT_TRUE(same_bits(messy.state(), by_set[0].state())) << i;
  }
}

TEST(Step, ClothOfPinsOnlyGoesWhereTheyGo) {
  Scene scene;
  constexpr float kCorners[] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
  constexpr std::uint32_t kAll[] = {0, 2, 1};
  pleat_garment_def def;
  must(call::garment_def_init(&def, sizeof def));
  def.positions = kCorners, def.vertex_count = 3;
  def.triangles = kAll, def.triangle_count = 1;
  def.pins = kAll, def.pin_count = 3;
  pleat_garment garment{};
  must(call::garment_create(scene, &def, nullptr, &garment));
  const pleat_cloth cloth = scene.cloth(garment);
  constexpr float kHigher[] = {0, .1f, 0, 0, .1f, 1, 1, .1f, 0};  // in the order of the pins
  must(call::cloth_move_pins(scene, cloth, kHigher, 0, 3));
  scene.step();
  const std::vector<float> x = scene.particles(cloth);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(x[3 * i + 1], 0.1f);
}

TEST(Step, ClothHangsFromItsPinsAtItsLength) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  s.air_damping = 2.0f;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
  scene.step(600);
  const std::vector<float> x = scene.particles(cloth);
  float lowest = 0.0f;
  for (std::size_t i = 1; i < 3 * 64; i += 3) lowest = std::min(lowest, x[i]);
  EXPECT_LT(lowest, -0.9f);
  EXPECT_GT(lowest, -1.3f);
  EXPECT_EQ(x[0], -0.5f);
  EXPECT_EQ(x[1], 0.0f);
  float fastest = 0.0f;
  for (std::size_t i = 3 * 64; i < x.size(); ++i) fastest = std::max(fastest, std::abs(x[i]));
  EXPECT_LT(fastest, 0.05f);
}

TEST(Step, SlowClothAtRestDoesNotWanderOff) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(16));
  scene.step(3600);
  const std::vector<float> start = scene.particles(cloth);
  scene.step(2000);
  const std::vector<float> end = scene.particles(cloth);
  for (std::size_t i = 0; i < 3 * 256; ++i) EXPECT_NEAR(end[i], start[i], 2e-6f) << i;
}

#ifdef PLEAT_WITH_COLLISION
TEST(Step, ABodyThatIsFarAwayChangesNoBit) {
  Scene alone, with_body;
  with_body.sphere(0, 0, 20, 1);
  pleat_cloth_settings s = Scene::default_settings();
  for (const std::uint32_t layer : {1u, 2u}) {  // one cloth on the other
    s.layer = layer;
    const pleat_cloth a = alone.cloth(alone.sheet(8), s), b = with_body.cloth(with_body.sheet(8), s);
    alone.step(60), with_body.step(60);
    EXPECT_EQ(alone.particles(a), with_body.particles(b));
    EXPECT_EQ(alone.vertices(a), with_body.vertices(b));
  }
}
#endif

TEST(Step, FreeClothFallsByTheDiscreteLaw) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  s.air_damping = s.inner_friction = 0.0f;
  const pleat_garment sheet = scene.sheet(4);
  const pleat_cloth cloth = scene.cloth(sheet, s);
  const float before = scene.particles(cloth)[3 * 10 + 1];
  scene.inside().particles.inverse_mass[0] = scene.inside().particles.inverse_mass[5];  // let the pins go
  scene.inside().particles.inverse_mass[3] = scene.inside().particles.inverse_mass[5];
  for (int i = 1; i <= 30; ++i) {  // carried pins fall alongside
    const float t = static_cast<float>(i) / 60, y = -0.5f * 9.81f * t * (t + 1.0f / 360);
    const float pins[2][3] = {{-0.5f, y, -0.5f}, {0.5f, y, -0.5f}};
    must(call::cloth_move_pins(scene, cloth, pins[0], 0, 2));
    scene.step();
  }
  const float t = 0.5f;
  EXPECT_NEAR(scene.particles(cloth)[3 * 10 + 1] - before, -0.5f * 9.81f * t * (t + 1.0f / 360), 2e-3f);
}

TEST(Step, ExtremeSettingsStayFinite) {
  for (const std::uint32_t integrator :
       {PLEAT_INTEGRATOR_SYMPLECTIC_EULER, PLEAT_INTEGRATOR_EXPLICIT_EULER, PLEAT_INTEGRATOR_RUNGE_KUTTA_4,
        PLEAT_INTEGRATOR_PROJECTED, PLEAT_INTEGRATOR_IMPLICIT_EULER}) {
    for (const float limit : {0.0f, 1.0f}) {
      Scene scene;
      pleat_cloth_settings s = Scene::default_settings();
      s.integrator = integrator;
      s.stiffness = 1e12f;
      s.bend_stiffness = s.edge_damping = s.bend_damping = s.air_damping = s.inner_friction = 1e6f;
      s.drag_coefficient = 1e3f;
      s.density = 1e-6f;
      s.stretch_limit = limit;
      s.substeps = 1;
      const pleat_cloth cloth = scene.cloth(scene.sheet(6), s);
      const float wind[3] = {1e4f, -1e4f, 1e4f}, gravity[3] = {1e4f, 1e4f, -1e4f};
      must(call::world_set_wind(scene, wind));
      must(call::world_set_gravity(scene, gravity));
      for (int i = 0; i < 100; ++i) {
        scene.step(1, i % 10 == 0 ? 1.0f : 0.1f);
        expect_finite(scene.particles(cloth));
        expect_finite(scene.vertices(cloth));
      }
    }
  }
}

TEST(Step, CollapsedClothStaysFinite) {
  Scene scene;
#ifdef PLEAT_WITH_COLLISION
  scene.sphere(0, 0, 0, 0.1f);  // its centre is where all particles are
#endif
  const pleat_cloth cloth = scene.cloth(scene.sheet(5));
  const std::vector<float> origin(75, 0.0f);
  must(call::cloth_write_particles(scene, cloth, origin.data(), nullptr, 25));
  expect_finite(scene.vertices(cloth));
  for (int i = 0; i < 60; ++i) {
    scene.step();
    expect_finite(scene.particles(cloth));
    expect_finite(scene.vertices(cloth));
  }
  EXPECT_GT(scene.stats().edges_skipped, 0u);
}

TEST(Step, PinsThatJumpTenMetresRecover) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8));
  scene.step(60);
  const float pins[2][3] = {{9.5f, 3, -0.5f}, {10.5f, 3, -0.5f}};
  must(call::cloth_move_pins(scene, cloth, pins[0], 0, 2));
  scene.step(1);
  expect_finite(scene.particles(cloth));
  scene.step(600);
  const std::vector<float> x = scene.particles(cloth);
  for (std::size_t i = 0; i < 3 * 64; i += 3) {
    EXPECT_NEAR(x[i], 10.0f, 1.5f);
    EXPECT_NEAR(x[i + 1], 2.5f, 1.5f);
  }
}

}  // namespace
}  // namespace pleat
