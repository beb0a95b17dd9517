// Soft bending is found 120 times a second and held between.
#include <algorithm>
#include <limits>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr float kSubstep = 1.0f / 360;  // s

/// Tells of each substep whether its force of bending is a new one, f, or held, h.
struct Watched {
  struct Seen {
    World* world = nullptr;
    std::vector<float> last;
    std::string substeps;
  } seen;
  Scene scene;
  pleat_cloth cloth;

  explicit Watched(const pleat_cloth_settings& settings = Scene::default_settings()) : scene(watching(&seen)) {
    cloth = scene.cloth(scene.sheet(8), settings);
    seen.world = &scene.inside();
    scene.step(40, 3 * kSubstep);  // until it moves, by whole times for which a force is held
  }
  std::string step(float dt) {
    seen.substeps.clear();
    scene.step(1, dt);
    return seen.substeps;
  }

 private:
  static pleat_world_def watching(Seen* seen) {
    pleat_world_def def = Scene::default_def();
    def.stage_user = seen;
    def.stage = [](const char* system, int begin, void* user) {
      Seen& s = *static_cast<Seen*>(user);
      if (s.world == nullptr || begin != 0 || std::strcmp(system, "slow_force") != 0) return;
      const Column<float>& y = s.world->bending.y;
      const std::vector<float> now(y.begin(), y.end());
      s.substeps += now == s.last ? 'h' : 'f';
      s.last = now;
    };
    return def;
  }
};

TEST(HeldBending, IsFoundEveryThirdSubstepThroughTicksOfAnyLength) {
  Watched w;
  EXPECT_EQ(w.step(6 * kSubstep), "fhhfhh");
  EXPECT_EQ(w.step(4 * kSubstep), "fhhf");
  EXPECT_EQ(w.step(4 * kSubstep), "hhfh");
  EXPECT_EQ(w.step(1 * kSubstep), "h");
  EXPECT_EQ(w.step(3 * kSubstep), "fhh");
}

TEST(HeldBending, IsHeldForItsTimeWhateverTheTicksWere) {
  Watched w;
  EXPECT_EQ(w.step(1e-4f).substr(0, 1), "f");  // of which 83 would be that time
  EXPECT_EQ(w.step(6 * kSubstep), "hhfhhf");
  Watched other;
  EXPECT_EQ(other.step(1e-6f), "f");
  const std::string substeps = other.step(4 * kSubstep);
  EXPECT_NE(substeps.find('f'), std::string::npos) << substeps;
}

TEST(HeldBending, BeginsAnewWhereTheClothIsChangedOrCarriedAway) {
  Watched w;
  const float from[3] = {0, 0, 0}, to[3] = {0.1f, 0, 0};
  EXPECT_EQ(w.step(4 * kSubstep), "fhhf");
  must(call::cloth_teleport(w.scene, w.cloth, from, to, nullptr));
  EXPECT_EQ(w.step(4 * kSubstep), "fhhf");
  pleat_cloth_settings s = w.scene.settings(w.cloth);
  s.bend_stiffness *= 2.0f;
  must(call::cloth_set(w.scene, w.cloth, &s));
  EXPECT_EQ(w.step(4 * kSubstep), "fhhf");
  std::vector<float> state = w.scene.particles(w.cloth);
  must(call::cloth_write_particles(w.scene, w.cloth, state.data(), state.data() + 3 * 64, 64));
  EXPECT_EQ(w.step(4 * kSubstep), "fhhf");
}

TEST(HeldBending, ATickThatBreaksLeavesNeitherItNorInnerFrictionBehind) {
  Watched w;
  const Vec3Column& held = w.scene.inside().held;
  const auto pulls = [&] { return std::any_of(held.y.begin(), held.y.end(), [](float y) { return y != 0.0f; }); };
  EXPECT_EQ(w.step(4 * kSubstep), "fhhf");
  EXPECT_TRUE(pulls());
  w.scene.inside().particles.velocity.y[20] = std::numeric_limits<float>::infinity();
  w.step(4 * kSubstep);
  EXPECT_EQ(w.scene.stats().fallbacks, 1u);
  EXPECT_FALSE(pulls());
  EXPECT_EQ(w.step(4 * kSubstep), "fhhf");
}

TEST(HeldBending, NeitherItNorInnerFrictionOutlivesAStateThatIsPutInItsPlace) {
  Watched calm, moved;
  calm.scene.step(60);
  const std::vector<float> state = calm.scene.particles(calm.cloth);
  const float wind[3] = {3, 1, 2}, none[3] = {0, 0, 0};
  must(call::world_set_wind(moved.scene, wind));
  moved.scene.step(50);
  must(call::world_set_wind(moved.scene, none));
  for (Watched* w : {&calm, &moved}) {
    must(call::cloth_write_particles(w->scene, w->cloth, state.data(), state.data() + 3 * 64, 64));
    w->scene.step(5);
  }
  EXPECT_TRUE(same_bits(calm.scene.particles(calm.cloth), moved.scene.particles(moved.cloth)));
}

TEST(HeldBending, IsHeldAsLongAsThatIsStableAndNoLongerThanItsTime) {
  EXPECT_EQ(Watched().step(1.0f / 30), "fhhfhhfhhfhh");
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = 2;  // of 1/120 s
  EXPECT_EQ(Watched(s).step(1.0f / 60), "ff");
  s = Scene::default_settings();
  s.bend_stiffness = 0.01f;  // stable in a step of two substeps
  EXPECT_EQ(Watched(s).step(6 * kSubstep), "fhfhfh");
  s.bend_stiffness = 0.1f;  // in half of one only
  EXPECT_EQ(Watched(s).step(3 * kSubstep), "ffffff");
  s = Scene::default_settings();
  s.integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
  s.stiffness = 30.0f;
  EXPECT_EQ(Watched(s).step(3 * kSubstep), "fff");
}

}  // namespace
}  // namespace pleat
