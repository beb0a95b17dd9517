// What a host may call from a callback of the world that calls it.
#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// Tries calls from within its own callback.
struct Caller {
  Scene* scene = nullptr;
  pleat_cloth cloth{};
  pleat_garment garment{};
  std::uint32_t tried = 0, refused = 0, read = 0;

  static pleat_world_def calling(Caller* caller) {
    pleat_world_def def = Scene::default_def();
    def.stage_user = caller;
    def.stage = [](const char*, int, void* user) { static_cast<Caller*>(user)->call_back(); };
    def.log = [](std::uint32_t, const char*, void*) {};
    return def;
  }
  void call_back() {
    if (scene == nullptr) return;
    pleat_world* world = *scene;
    pleat_cloth_def def;
    must(call::cloth_def_init(&def, sizeof def));
    def.garment = garment;
    pleat_cloth_settings settings = Scene::default_settings();
    settings.level = 3;
    pleat_cloth made{};
    const float wind[3] = {1, 0, 0};
    pleat_contact_report report{};
    report.size = sizeof report;
    for (const pleat_result result :
         {call::cloth_create(world, &def, &made), call::cloth_set(world, cloth, &settings),
          call::cloth_destroy(world, cloth), call::world_step(world, 0.01f), call::world_set_wind(world, wind),
          call::cloth_set_visible(world, cloth, 0), call::cloth_contact_report(world, cloth, &report)}) {
      ++tried, refused += result == pleat_result{PLEAT_ERROR_ARGUMENT};
    }
    call::world_destroy(world);
    pleat_cloth_info info{};
    info.size = sizeof info;
    read += call::cloth_info(world, cloth, &info) == pleat_result{PLEAT_OK} && info.particles == 16;
  }
};

TEST(Busy, CallbacksOfATickMayReadAndNotChange) {
  Caller caller;
  Scene scene(Caller::calling(&caller));
  caller.garment = scene.sheet(4);
  caller.cloth = scene.cloth(caller.garment);
  caller.scene = &scene;
  scene.step(2);
  EXPECT_GT(caller.tried, 100u);
  EXPECT_EQ(caller.refused, caller.tried);
  EXPECT_EQ(7 * caller.read, caller.tried);

  caller.tried = caller.refused = 0;
  pleat_cloth_settings s = scene.settings(caller.cloth);
  s.level = 2;
  must(call::cloth_set(scene, caller.cloth, &s));  // draws
#ifdef PLEAT_WITH_SMOOTHING
  EXPECT_GT(caller.tried, 0u);
#endif
  EXPECT_EQ(caller.refused, caller.tried);
  caller.scene = nullptr;
  scene.step();
  must(call::cloth_destroy(scene, caller.cloth));
}

TEST(Busy, SoMayThoseThatAreGivenLines) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4));
  struct Asked {
    pleat_world* world;
    pleat_cloth cloth;
    std::uint32_t refused = 0;
    void destroy() { refused += call::cloth_destroy(world, cloth) == pleat_result{PLEAT_ERROR_ARGUMENT}; }
  } asked{scene, cloth};
  must(call::world_debug_draw(
      scene, PLEAT_DEBUG_COARSE_EDGES,
      [](const float*, const float*, std::uint32_t, void* user) { static_cast<Asked*>(user)->destroy(); }, &asked));
  EXPECT_EQ(asked.refused, 33u);
  must(call::world_explain(
      scene, [](const char*, void* user) { static_cast<Asked*>(user)->destroy(); }, &asked));
  EXPECT_GT(asked.refused, 43u);
  EXPECT_EQ(scene.info(cloth).particles, 16u);
}

}  // namespace
}  // namespace pleat
