// What the library tells a host of contact is what the exact metrics measure from outside.
#include <gtest/gtest.h>

#include <algorithm>

#include "demo/quality/scene_quality.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::demo {
namespace {

const pleat_api& api() { return *pleat_get_api(PLEAT_API_MAJOR); }

void expect_agreement(SceneRequest request, float narrower, float lower) {
  constexpr double kTolerance = 0.01;  // mm
  SceneDef def = load_scene(api(), request);
  Scene scene(api(), std::move(def));
  std::vector<DrawnSurface> surfaces{make_surface(scene, 0)};
  std::vector<float> pushed;
  double deepest = 0.0;
  for (uint32_t frame = 0; frame < request.frames.value(); ++frame) {
    scene.advance();
    // Pushed into the body from all sides, so that there is something to measure.
    scene.read_particles(0, pushed);
    for (size_t i = 0; i < pushed.size(); ++i) pushed[i] = i % 3 == 1 ? pushed[i] - lower : narrower * pushed[i];
    ASSERT_EQ(api().cloth_write_particles(scene.world(), scene.cloths()[0], pushed.data(), nullptr,
                                          uint32_t(pushed.size() / 3)),
              pleat_result{PLEAT_OK});
    read_vertices(scene, 0, surfaces[0]);
    SceneQuality exact(scene);
    exact.add_frame(scene, surfaces);
    pleat_contact_report report{};
    report.size = sizeof report;
    ASSERT_EQ(api().cloth_contact_report(scene.world(), scene.cloths()[0], &report), pleat_result{PLEAT_OK});
    const Quality quality = exact.result();
    SCOPED_TRACE(testing::Message() << request.scene << " frame " << frame);
    EXPECT_NEAR(1e3 * double(std::max(report.particle_depth, report.pin_depth)), *quality.penetration_particle_mm,
                kTolerance);
    EXPECT_GE(1e3 * double(report.face_depth), *quality.penetration_interior_mm - kTolerance);
    EXPECT_LE(1e3 * double(report.face_depth), *quality.penetration_interior_mm + 3.0);  // that looks at samples
    EXPECT_NEAR(1e3 * double(report.drawn_depth), *quality.penetration_drawn_mm, kTolerance);
    deepest = std::max(deepest, *quality.penetration_particle_mm);
  }
  EXPECT_GT(deepest, 5.0);  // otherwise nothing was compared
}

TEST(ContactReport, AgreesWithTheExactMetricsOnCapsules) {
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "built without collision";
  expect_agreement({.scene = "skirt_kick", .clip = {}, .rate = 30.0, .frames = 8, .settings = {}}, 0.8f, 0.0f);
}

TEST(ContactReport, AgreesWithTheExactMetricsOnAMesh) {
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "built without collision";
  expect_agreement({.scene = "drape_mesh_sphere:12", .clip = {}, .rate = 30.0, .frames = 3, .settings = {}}, 1.0f,
                   0.1f);
}

}  // namespace
}  // namespace pleat::demo
