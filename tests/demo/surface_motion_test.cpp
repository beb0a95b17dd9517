#include "demo/quality/surface_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "demo/quality/scene_surface.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::demo {
namespace {

using Vertex = DrawnSurface::Vertex;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A square of two triangles with a side of 1 m, drawn as it is: edges 01, 12, 23, 30 and the diagonal 02.
const SurfaceMesh kSquare{{0, 1, 2, 0, 2, 3},
                          {0, 1, 2, 0, 2, 3},
                          {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}},
                          {1.0, 1.0, 1.0, 1.0, std::numbers::sqrt2},
                          1.0};
const std::vector<Vector3d> kCorners = {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}};

/// Shows the square to the meter, moved by `transform`.
void show(SurfaceMotionMeter& meter, const Eigen::Affine3d& transform) {
  std::vector<float> particles;
  std::vector<Vertex> drawn;
  const Eigen::Vector3f normal = (transform.linear() * Vector3d::UnitY()).normalized().cast<float>();
  for (const Vector3d& corner : kCorners) {
    const Eigen::Vector3f p = (transform * corner).cast<float>();
    particles.insert(particles.end(), {p.x(), p.y(), p.z()});
    drawn.push_back({{p.x(), p.y(), p.z()}, {normal.x(), normal.y(), normal.z()}});
  }
  meter.add_frame(particles, drawn);
}

SurfaceMotion motion_of(int frames, const std::function<Eigen::Affine3d(int frame)>& transform) {
  SurfaceMotionMeter meter(kSquare);
  for (int frame = 0; frame < frames; ++frame) show(meter, transform(frame));
  return meter.result();
}

TEST(SurfaceMotion, ARigidlyTurningSheetTurnsByItsAngle) {
  const SurfaceMotion motion = motion_of(
      20, [](int frame) { return Eigen::Affine3d(Eigen::AngleAxisd(3.0 * kDegree * frame, Vector3d(1, 0, 0))); });
  EXPECT_NEAR(motion.normal_turn_deg, 3.0, 0.011);
  EXPECT_NEAR(motion.flat_turn_deg, 3.0, 0.011);
  EXPECT_NEAR(motion.length_rms_percent, 0.0, 1e-4);
  EXPECT_NEAR(motion.area_worst_percent, 0.0, 1e-4);
}

TEST(SurfaceMotion, SecondDifferenceOfAParabola) {
  const SurfaceMotion motion = motion_of(10, [](int frame) {  // y = 2 mm f^2 + 30 mm f
    return Eigen::Affine3d(Eigen::Translation3d(0.0, 0.002 * frame * frame + 0.03 * frame, 0.0));
  });
  EXPECT_NEAR(motion.acceleration_mm, 4.0, 1e-3);
  EXPECT_EQ(motion.normal_turn_deg, 0.0);
}

TEST(SurfaceMotion, UniformMotionHasNoAcceleration) {
  const SurfaceMotion motion =
      motion_of(10, [](int frame) { return Eigen::Affine3d(Eigen::Translation3d(0.25 * frame, -0.5 * frame, 0.0)); });
  EXPECT_NEAR(motion.acceleration_mm, 0.0, 1e-6);
}

TEST(SurfaceMotion, LengthAndAreaOfAScaledSheet) {
  const SurfaceMotion motion = motion_of(4, [](int frame) {  // at rest in the even frames
    return Eigen::Affine3d(Eigen::Scaling(frame % 2 == 0 ? 1.0 : 0.9));
  });
  EXPECT_NEAR(motion.length_rms_percent, 10.0 * std::sqrt(0.5), 1e-4);
  EXPECT_NEAR(motion.area_mean_percent, -19.0 / 2.0, 1e-4);
  EXPECT_NEAR(motion.area_worst_percent, -19.0, 1e-4);
}

TEST(AngleHistogram, PercentileLeavesOutTheWorst) {
  AngleHistogram angles;
  EXPECT_EQ(angles.percentile(0.99), 0.0) << "nothing counted";
  for (int i = 0; i < 99; ++i) angles.add(2.0);
  angles.add(180.0);
  EXPECT_NEAR(angles.percentile(0.99), 2.0, 1e-12);
  EXPECT_NEAR(angles.percentile(1.0), 180.0, 1e-12);
}

SceneDef load(const std::string& scene, std::vector<std::string> settings = {}) {
  SceneRequest request;
  request.scene = scene;
  request.settings = std::move(settings);
  return load_scene(*pleat_get_api(PLEAT_API_MAJOR), request);
}

TEST(SceneSurface, FindsTheDrawnVerticesOfEveryCoarseEdge) {
  const pleat_api& api = *pleat_get_api(PLEAT_API_MAJOR);
  const size_t fan = api.features & PLEAT_FEATURE_SMOOTHING ? 4 : 1, fine = fan == 1 ? 1 : 6;
  for (const auto& [settings, segments] :
       {std::pair(std::vector<std::string>{}, fan), std::pair(std::vector<std::string>{"level=3"}, fine)}) {
    const SurfaceMesh mesh = surface_mesh(api, load("hanging_square:9", settings));
    ASSERT_EQ(mesh.edges.size(), 3u * 8 * 8 + 2 * 8);
    for (const auto& edge : mesh.edges) EXPECT_EQ(edge.size(), segments + 1);
    EXPECT_NEAR(mesh.rest_area, 1.0, 1e-5);
  }
}

TEST(SceneSurface, ARoundSkirtIsTrueToItselfAtRest) {
  const pleat_api& api = *pleat_get_api(PLEAT_API_MAJOR);
  SceneDef def = load("skirt_kick");
  def.motion = {};
  def.gravity.setZero();
  def.frames = 5;
  def.settings.surface = api.features & PLEAT_FEATURE_SMOOTHING ? PLEAT_SURFACE_PN : PLEAT_SURFACE_FLAT;
  uint32_t steps = 0;
  const SceneSurface surface = measure_surface(api, def, [&] { ++steps; });
  EXPECT_EQ(steps, def.frames);
  EXPECT_FALSE(surface.resting) << "no body moves";
  EXPECT_LT(surface.moving.length_rms_percent, 0.1);
  EXPECT_NEAR(surface.moving.area_worst_percent, 0.0, 0.1);
  EXPECT_LT(surface.moving.normal_turn_deg, 0.5);
}

}  // namespace
}  // namespace pleat::demo
