// Cloth that starts stretched, or inside a body.
#include "systems/largest_stretch.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 8;

/// The root mean square speed, m/s, in each of the first ticks of a sheet that starts `stretch` times as deep as it is.
std::vector<float> speeds(float stretch, std::uint32_t substeps) {
  Scene scene;
  const pleat_garment garment = scene.sheet(kSide);
  const pleat_cloth model = scene.cloth(garment);
  std::vector<float> start = scene.particles(model);
  must(call::cloth_destroy(scene, model));
  for (std::size_t i = 2; i < start.size(); i += 3) start[i] *= stretch;
  pleat_cloth_def def;
  must(call::cloth_def_init(&def, sizeof def));
  def.garment = garment;
  def.positions = start.data();
  def.settings.substeps = substeps;
  pleat_cloth cloth{};
  must(call::cloth_create(scene, &def, &cloth));
  std::vector<float> found;
  for (int tick = 0; tick < 12; ++tick) {
    scene.step(1, 1.0f / 60);
    const ConstVec3View velocity = scene.inside().particles.velocity.view();
    float sum = 0.0f;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) sum += dot(velocity[i], velocity[i]);
    found.push_back(std::sqrt(sum / (kSide * kSide)));
  }
  return found;
}

TEST(Settling, AStretchedStartIsNotThrown) {
  for (const std::uint32_t substeps : {0u, 64u}) {
    for (const float stretch : {1.05f, 1.2f, 2.0f}) {
      const std::vector<float> found = speeds(stretch, substeps);
      for (std::size_t tick = 0; tick < found.size(); ++tick) {
        const float fallen = 9.81f * static_cast<float>(tick + 1) / 60;
        EXPECT_LT(found[tick], fallen + 1.0f) << stretch << ", tick " << tick << ", substeps " << substeps;
      }
    }
  }
}

TEST(Settling, AStartThatFitsMovesAtOnce) { EXPECT_NEAR(speeds(1.0f, 0)[0], 9.81f / 60, 0.02f); }

#ifdef PLEAT_WITH_COLLISION
/// The highest that any of a sheet's particles gets in .3 s, m. It starts in a cylinder whose crest is `depth`
/// higher, and clears that by no more than its thickness.
float highest(float depth, std::uint32_t substeps) {
  constexpr float kRadius = 0.2f;
  Scene scene;
  pleat_collider_def body;
  must(call::collider_def_init(&body, sizeof body));
  body.radius = kRadius;
  const float y = depth - kRadius;
  const float a[3] = {-2, y, 0}, b[3] = {2, y, 0};
  std::copy_n(a, 3, body.a), std::copy_n(b, 3, body.b);
  pleat_collider collider{};
  must(call::collider_create(scene, &body, &collider));
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = substeps;
  const pleat_cloth cloth = scene.cloth(scene.sheet(6), s);
  float top = 0.0f;
  for (int tick = 0; tick < 18; ++tick) {
    scene.step();
    const std::vector<float> x = scene.particles(cloth);  // and their velocities
    for (std::size_t i = 1; i < x.size() / 2; i += 3) top = std::max(top, x[i]);
  }
  return top;
}

TEST(Settling, AStartInsideABodyIsNotThrown) {
  for (const std::uint32_t substeps : {0u, 16u, 64u}) {
    for (const float depth : {0.01f, 0.03f, 0.06f}) {
      EXPECT_LT(highest(depth, substeps), depth + 0.026f) << depth << ", substeps " << substeps;
    }
  }
}

TEST(Settling, AStartTooNearTheLayerBelowIsNotHeld) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  s.layer = 1;
  scene.cloth(scene.sheet(kSide), s);
  s.layer = 2, s.thickness = 0.02f;
  scene.cloth(scene.sheet(kSide), s);
  scene.step(1, 1.0f / 60);
  const World& world = scene.inside();
  const std::uint32_t last = world.clothes[1].particle_begin + kSide * kSide - 1;
  EXPECT_GT(length(world.particles.velocity.view()[last]), 0.0f);
}
#endif

TEST(Settling, AStateThatIsLoadedInMotionGoesOn) {
  Scene plays, loads;
  const pleat_cloth first = plays.cloth(plays.sheet(8)), second = loads.cloth(loads.sheet(8));
  std::vector<float> pins{-0.5f, 0, -0.5f, 0.5f, 0, -0.5f};
  const auto swing = [&](Scene& scene, pleat_cloth cloth, int tick) {
    for (std::size_t k = 1; k < pins.size(); k += 3) pins[k] = 0.3f * std::sin(0.15f * static_cast<float>(tick));
    must(call::cloth_move_pins(scene, cloth, pins.data(), 0, 2));
    scene.step();
  };
  float longest = 0.0f;
  for (int tick = 0; tick < 40; ++tick) {
    swing(plays, first, tick);
    const LargestStretch stretch{.garment = &plays.inside().clothes[0].garment(),
                                 .position = plays.inside().particles.position.view(),
                                 .inverse_mass = plays.inside().particles.inverse_mass.data()};
    longest = stretch.run();
    if (longest > 0.007f) break;
  }
  ASSERT_GT(longest, 0.007f) << "would be held";
  const std::vector<float> state = plays.particles(first);
  must(call::cloth_write_particles(loads, second, state.data(), state.data() + 3 * 64, 64));
  swing(plays, first, 40), swing(loads, second, 40);
  const std::vector<float> a = plays.particles(first), b = loads.particles(second);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], i < 3 * 64 ? 1e-3f : 0.1f);
}

}  // namespace
}  // namespace pleat
