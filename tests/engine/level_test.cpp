// The level of the drawn triangles changes between ticks, as crowds have it do all the time.
#include <cmath>

#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_SMOOTHING

namespace pleat {
namespace {

TEST(Level, FoldsStayOnTheirWayWhenItChanges) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8));
  const Column<float>& side = scene.inside().surface.fold_side;
  std::uint32_t under_way = 0;
  for (int tick = 0; tick < 60; ++tick) {  // pushed together and apart, it folds to and fro
    const float push = 0.2f * std::sin(0.3f * static_cast<float>(tick));
    const float pins[] = {push - 0.5f, 0, -0.5f, 0.5f - push, 0, -0.5f};
    must(call::cloth_move_pins(scene, cloth, pins, 0, 2));
    const std::vector<float> last(side.begin(), side.end());
    scene.step();
    const std::vector<float> before(side.begin(), side.end());
    pleat_cloth_settings s = scene.settings(cloth);
    s.level = s.level == 2 ? 3 : 2;
    must(call::cloth_set(scene, cloth, &s));
    for (std::size_t e = 0; e < before.size(); ++e) {
      under_way += tick > 0 && std::abs(before[e] - last[e]) > 0.1f;
      ASSERT_NEAR(side[e], before[e], 1e-6f) << "edge " << e << ", tick " << tick;
    }
  }
  EXPECT_GT(under_way, 50u);
}

}  // namespace
}  // namespace pleat

#endif
