// What pictures of scenes show.
#include "demo/view.h"

#include <gtest/gtest.h>

#include <set>

#include "demo/scenes/scene_reader.h"

namespace pleat::demo {
namespace {

/// As they are drawn, or as they are simulated.
std::multiset<uint32_t> colours_of_clothes(const char* name, bool coarse = false) {
  const pleat_api& api = *pleat_get_api(PLEAT_API_MAJOR);
  SceneRequest request;
  request.scene = name;
  const Scene scene(api, load_scene(api, request));
  View view(scene, cloth_box(scene), 1.0f);
  const size_t bodies = view.bodies(scene).meshes.size();
  const Frame frame = coarse ? view.coarse(scene) : view.frame(scene);
  std::multiset<uint32_t> colours;
  for (size_t m = bodies; m < frame.meshes.size(); ++m) colours.insert(frame.meshes[m].front);
  return colours;
}

TEST(View, ClothesOverEachOtherAreToldApart) {
  const std::multiset<uint32_t> colours = colours_of_clothes("layers:5");
  ASSERT_EQ(colours.size(), 2u);
  EXPECT_NE(*colours.begin(), *colours.rbegin());
}

TEST(View, CopiesOfAClothLookAlike) {
  const std::multiset<uint32_t> colours = colours_of_clothes("crowd:3");
  ASSERT_EQ(colours.size(), 3u);
  EXPECT_EQ(*colours.begin(), *colours.rbegin());
}

TEST(View, CoarseTrianglesOfAllClothsAreShown) {
  for (const char* scene : {"layers:5", "crowd:3"})
    EXPECT_EQ(colours_of_clothes(scene, true), colours_of_clothes(scene)) << scene;
}

}  // namespace
}  // namespace pleat::demo
