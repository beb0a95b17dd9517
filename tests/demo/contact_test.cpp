// Nothing goes through: whole scenes, fast and real motion, measured as `pleat run` measures them.
#include <gtest/gtest.h>

#include <filesystem>

#include "demo/quality/scene_quality.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::demo {
namespace {

const pleat_api& api() { return *pleat_get_api(PLEAT_API_MAJOR); }

Quality run(SceneDef def) {
  const uint32_t frames = def.frames;
  Scene scene(api(), std::move(def));
  SceneQuality quality(scene);
  std::vector<DrawnSurface> surfaces{make_surface(scene, 0)};
  for (uint32_t frame = 0; frame < frames; ++frame) {
    scene.advance();
    read_vertices(scene, 0, surfaces[0]);
    quality.add_frame(scene, surfaces);
  }
  quality.measure_rest(scene);
  return quality.result();
}

TEST(Contact, SlowKickAtAnySpeedStaysOutside) {
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "built without collision";
  for (const double speed : {1.0, 2.0, 3.0}) {
    for (const double rate : {30.0, 60.0}) {
      SceneRequest request{.scene = "skirt_kick", .clip = {}, .rate = rate, .frames = {}, .settings = {}};
      request.frames = uint32_t(4.0 * rate / speed);
      request.speed = speed;
      const Quality quality = run(load_scene(api(), request));
      SCOPED_TRACE(testing::Message() << speed << " times as fast, " << rate << " Hz");
      EXPECT_LT(*quality.penetration_particle_mm, 0.05);
      EXPECT_LT(*quality.penetration_interior_mm, 0.05);
      EXPECT_LT(quality.strain_max_percent, speed == 1.0 ? 3.0 : 10.0);
      if (speed == 1.0) {
        EXPECT_LT(*quality.rest_jitter_mm, 0.05);
      }
    }
  }
}

TEST(Contact, SlowRealMotionsStayInsideTheirSkirt) {
  const std::filesystem::path data = std::filesystem::path(PLEAT_SHARED_DATA) / "mocap";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no real data at " << data;
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "built without collision";
  for (const auto& file : std::filesystem::directory_iterator(data)) {
    if (file.path().extension() != ".bvh") continue;
    SceneRequest request{.scene = "skirt_kick", .clip = file.path(), .rate = 30.0, .frames = {}, .settings = {}};
    const Quality quality = run(load_scene(api(), request));
    SCOPED_TRACE(file.path().filename());
    EXPECT_LT(*quality.penetration_particle_mm, 0.05);
    EXPECT_LT(*quality.penetration_interior_mm, *quality.penetration_pinned_mm + 0.05);  // the waistband is the host's
    EXPECT_LT(*quality.penetration_pinned_mm, 5.0);
    EXPECT_LT(quality.strain_p99_percent, 5.0);
    EXPECT_LT(*quality.rest_jitter_mm, 0.05);
  }
}

}  // namespace
}  // namespace pleat::demo
