// Cloth of many rows of particles keeps its length with the default settings.
#include <gtest/gtest.h>

#include "demo/quality/scene_quality.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::demo {
namespace {

TEST(DeepCloth, KeepsItsLengthThroughItsFirstSwing) {
  const pleat_api& api = *pleat_get_api(PLEAT_API_MAJOR);
  for (const char* name : {"hanging_square:8", "hanging_square:16"}) {
    SceneRequest request{.scene = name, .clip = {}, .rate = 60.0, .frames = 60, .settings = {"surface=flat"}};
    Scene scene(api, load_scene(api, request));
    SceneQuality quality(scene);
    const std::vector<DrawnSurface> surfaces{make_surface(scene, 0)};
    for (uint32_t frame = 0; frame < 60; ++frame) {
      scene.advance();
      quality.add_frame(scene, surfaces);
    }
    EXPECT_LT(quality.result().strain_max_percent, 3.0) << name;
    EXPECT_LT(quality.result().stretch_rms_percent, 0.5) << name;
  }
}

}  // namespace
}  // namespace pleat::demo
