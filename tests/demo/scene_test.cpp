#include "demo/scenes/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "demo/input_error.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/icosphere.h"
#include "demo/scenes/scene_files.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::demo {
namespace {

using Indices = std::vector<uint32_t>;

const pleat_api& api() { return *pleat_get_api(PLEAT_API_MAJOR); }

SceneDef load(const std::string& name) {
  SceneRequest request;
  request.scene = name;
  return load_scene(api(), request);
}

std::string load_shipped(const std::string& file) {
  std::ostringstream text;
  text << SceneFile("kick").open(file)->rdbuf();
  return text.str();
}

/// A scene file that lives as long as the test.
class SceneText {
 public:
  explicit SceneText(const std::string& text)
      : path_(testing::TempDir() + "scene_test_" + testing::UnitTest::GetInstance()->current_test_info()->name() +
              ".json") {
    std::ofstream(path_) << text;
  }
  ~SceneText() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }
  /// What the reader says when it refuses the file.
  std::string complaint() const {
    try {
      load(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  std::string path_;
};

// --- the workloads, against their definitions -----------------------------------------------------------------------

TEST(Workload, SkirtIsBuiltAsDefined) {
  const SceneDef def = load("skirt_kick");
  const Indices counts = {8, 12, 14, 16, 16};
  std::vector<float> positions;
  Indices first, triangles;
  for (uint32_t r = 0; r < 5; ++r) {
    first.push_back(uint32_t(positions.size() / 3));
    for (uint32_t i = 0; i < counts[r]; ++i) {
      const double a = 2.0 * std::numbers::pi * i / counts[r], radius = 0.14 + 0.0525 * r;
      for (const double x : {radius * std::sin(a), 1.05 - 0.125 * r, radius * std::cos(a)})
        positions.push_back(float(x));
    }
  }
  for (uint32_t r = 0; r < 4; ++r) {
    const uint32_t n = counts[r], m = counts[r + 1];
    for (uint32_t i = 0, j = 0; i < n || j < m;) {
      const uint32_t a = first[r] + i % n, b = first[r + 1] + j % m;
      if (j >= m || (i < n && (i + 1) * m < (j + 1) * n)) {
        triangles.insert(triangles.end(), {a, b, first[r] + (i + 1) % n});
        ++i;
      } else {
        triangles.insert(triangles.end(), {a, b, first[r + 1] + (j + 1) % m});
        ++j;
      }
    }
  }
  ASSERT_EQ(def.garment.vertex_count(), 66u);
  EXPECT_EQ(def.garment.triangles, triangles);
  for (size_t i = 0; i < positions.size(); ++i) EXPECT_NEAR(def.garment.positions[i], positions[i], 1e-6) << i;
  EXPECT_EQ(def.pins, (Indices{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(def.frames, 300u);
  EXPECT_EQ(def.settings.density, 0.2f);
  EXPECT_EQ(def.settings.thickness, 0.005f);
  EXPECT_EQ(def.settings.air_damping, 0.1f);
  EXPECT_EQ(def.settings.friction, 0.2f);
}

TEST(Workload, KickMovesAsDefined) {
  const SceneDef def = load("skirt_kick");
  const double t = 0.3, w = 2.0 * std::numbers::pi, degree = std::numbers::pi / 180.0;
  const BodyPose pose = def.motion(t);
  ASSERT_EQ(pose.capsules.size(), 7u);
  const double psi = 10.0 * degree * std::sin(w * t);
  const auto moved = [&](double x, double y, double z) {
    return Eigen::Vector3d(std::cos(psi) * x + std::sin(psi) * z + 0.04 * std::sin(w * t),
                           y + 0.02 * std::sin(2.0 * w * t), -std::sin(psi) * x + std::cos(psi) * z);
  };
  const double k = 0.5 * (1.0 - std::cos(w * t)), a = 100.0 * degree * k, b = a - 60.0 * degree * k;
  const double knee_y = 0.9 - 0.42 * std::cos(a), knee_z = 0.42 * std::sin(a);
  const double ankle_y = knee_y - 0.42 * std::cos(b), ankle_z = knee_z + 0.42 * std::sin(b);
  const auto expect = [](const Eigen::Vector3f& actual, const Eigen::Vector3d& expected) {
    EXPECT_LT((actual.cast<double>() - expected).norm(), 1e-6) << actual.transpose() << " / " << expected.transpose();
  };
  expect(pose.capsules[0].a, moved(-0.05, 0.95, 0.0));
  expect(pose.capsules[0].b, moved(0.05, 0.95, 0.0));
  expect(pose.capsules[1].a, moved(-0.09, 0.9, 0.0));
  expect(pose.capsules[1].b, moved(-0.09, knee_y, knee_z));
  expect(pose.capsules[2].b, moved(-0.09, ankle_y, ankle_z));
  expect(pose.capsules[3].b, moved(-0.09, ankle_y + 0.15 * std::sin(b), ankle_z + 0.15 * std::cos(b)));
  expect(pose.capsules[6].b, moved(0.09, 0.06, 0.15));
  const float radii[] = {0.11f, 0.075f, 0.055f, 0.045f, 0.075f, 0.055f, 0.045f};
  for (size_t i = 0; i < 7; ++i) EXPECT_EQ(pose.capsules[i].radius, radii[i]) << i;
  expect(pose.hips.translation().cast<float>(), moved(0.0, 0.0, 0.0));
}

TEST(Workload, GridIsBuiltAsDefined) {
  const SceneDef def = load("hanging_square:5");
  ASSERT_EQ(def.garment.vertex_count(), 25u);
  for (uint32_t i = 0; i < 5; ++i) {
    for (uint32_t j = 0; j < 5; ++j) {
      const float* p = &def.garment.positions[3 * (5 * i + j)];
      EXPECT_NEAR(p[0], -0.5 + j / 4.0, 1e-6);
      EXPECT_NEAR(p[1], 2.0, 1e-6);
      EXPECT_NEAR(p[2], -0.5 + i / 4.0, 1e-6);
    }
  }
  Indices triangles;
  for (uint32_t i = 0; i < 4; ++i) {
    for (uint32_t j = 0; j < 4; ++j) {
      const uint32_t a = 5 * i + j, b = a + 1, c = a + 5, d = c + 1;
      triangles.insert(triangles.end(), {a, c, d, a, d, b});
    }
  }
  EXPECT_EQ(def.garment.triangles, triangles);
  EXPECT_EQ(def.pins, (Indices{0, 4}));
  EXPECT_EQ(def.frames, 600u);
}

TEST(Workload, DrapesAndCrowdAreAsDefined) {
  const SceneDef sphere = load("drape_sphere:16"), mesh = load("drape_mesh_sphere:16"), crowd = load("crowd:70");
  EXPECT_EQ(sphere.garment.vertex_count(), 256u);
  EXPECT_FLOAT_EQ(sphere.garment.positions[1], 0.45f);
  EXPECT_EQ(sphere.settings.friction, 0.5f);
  EXPECT_TRUE(sphere.pins.empty());
  EXPECT_EQ(std::get<TriangleMesh>(mesh.fixed.at(0).shape).triangle_count(), 1280u);
  ASSERT_EQ(crowd.origins.size(), 70u);
  EXPECT_EQ(crowd.origins[69], Eigen::Vector3d(15.0, 0.0, 6.0));
  EXPECT_EQ(crowd.rate, 30.0);
  EXPECT_EQ(load("crowd").origins.size(), 1000u);
}

TEST(Icosphere, IsClosedAndOutward) {
  const TriangleMesh mesh = make_icosphere(3, {1, 2, 3}, 0.5);
  EXPECT_EQ(mesh.triangle_count(), 1280u);
  EXPECT_EQ(mesh.vertex_count(), 642u);
  const SurfaceTopology topology = inspect_topology(mesh.triangles);
  EXPECT_TRUE(topology.manifold);
  EXPECT_EQ(topology.border_edges, 0u);
  double volume = 0.0;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const float* p = &mesh.positions[3 * mesh.triangles[t + size_t(k)]];
      corners.col(k) = Eigen::Vector3d(p[0], p[1], p[2]) - Eigen::Vector3d(1, 2, 3);
    }
    volume += corners.determinant() / 6.0;
  }
  EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi * 0.125, 0.005);
}

// --- running --------------------------------------------------------------------------------------------------------

TEST(Scene, EveryShippedSceneRunsAndStaysFinite) {
  for (const std::string& name : shipped_scenes()) {
    SceneDef def = load(name == "crowd" ? "crowd:3" : name);
    if ((def.motion || !def.fixed.empty()) && !(api().features & PLEAT_FEATURE_COLLISION)) continue;
    Scene scene(api(), std::move(def));
    DrawnSurface surface = make_surface(scene, 0);
    for (int frame = 0; frame < 20; ++frame) scene.advance();
    read_vertices(scene, 0, surface);
    EXPECT_TRUE(all_finite(surface)) << name;
    EXPECT_TRUE(inspect_topology(surface.indices).manifold) << name;
  }
}

TEST(Scene, PinsFollowTheHips) {
  Scene scene(api(), load("skirt_kick"));
  for (int frame = 0; frame < 18; ++frame) scene.advance();  // 0.3 s
  std::vector<float> particles;
  scene.read_particles(0, particles);
  const BodyPose pose = scene.def().motion(0.3);
  for (const uint32_t pin : scene.def().pins) {
    const float* rest = &scene.def().garment.positions[3 * pin];
    const Eigen::Vector3d expected = pose.hips * Eigen::Vector3d(rest[0], rest[1], rest[2]);
    for (Eigen::Index axis = 0; axis < 3; ++axis) EXPECT_NEAR(particles[3 * pin + size_t(axis)], expected[axis], 1e-5);
  }
}

TEST(Scene, ASettledCopyElsewhereDoesTheSame) {
  SceneDef def = load("crowd:2");
  Scene scene(api(), std::move(def));
  for (int frame = 0; frame < 10; ++frame) scene.advance();
  std::vector<float> here, there;
  scene.read_particles(0, here);
  scene.read_particles(1, there);
  for (size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i] + (i % 3 == 0 ? 3.0f : 0.0f), there[i], 1e-3) << i;
}

TEST(Scene, TheSkirtOfAClipClearsTheFigureAtTheWaist) {
  const SceneDef def = load("kick");
  const BodyPose pose = def.motion(0.0);
  for (const uint32_t pin : def.pins) {
    const Eigen::Vector3f p(&def.garment.positions[3 * pin]);
    const CapsulePose& pelvis = pose.capsules.at(0);
    const Eigen::Vector3f axis = pelvis.b - pelvis.a;
    const float s = std::clamp(axis.dot(p - pelvis.a) / std::max(axis.squaredNorm(), 1e-12f), 0.0f, 1.0f);
    EXPECT_GT((p - pelvis.a - s * axis).norm(), pelvis.radius);
  }
  EXPECT_GT(def.frames, 60u);
  EXPECT_TRUE(def.ground);
}

TEST(Scene, SpeedIsThatOfTheMotionOnceItHasBegun) {
  SceneRequest request;
  request.scene = "skirt_kick";
  const SceneDef once = load_scene(api(), request);
  request.speed = 3.0;
  const SceneDef thrice = load_scene(api(), request);
  for (const double seconds : {0.0, 0.1, 0.7}) {
    EXPECT_EQ(thrice.motion(seconds).capsules[1].b, once.motion(3.0 * seconds).capsules[1].b);
  }
  EXPECT_EQ(thrice.motion(-0.2).capsules[1].b, once.motion(-0.2).capsules[1].b);
  request.scene = "hanging_square";
  EXPECT_THROW(load_scene(api(), request), InputError) << "nothing moves";
}

TEST(Scene, RealClipsCanBePlayed) {
  const std::filesystem::path data = std::filesystem::path(PLEAT_SHARED_DATA) / "mocap";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no real data at " << data;
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "built without collision";
  for (const char* name : {"mass_kick.bvh", "mass_run.bvh", "mass_pirouette.bvh", "cmu_13_13_forward_jump.bvh"}) {
    SceneRequest request;
    request.clip = (data / name).string();
    request.frames = 30;
    Scene scene(api(), load_scene(api(), request));
    for (int frame = 0; frame < 30; ++frame) scene.advance();
    std::vector<float> particles;
    scene.read_particles(0, particles);
    for (const float x : particles) ASSERT_TRUE(std::isfinite(x) && std::abs(x) < 100.0f) << name;
  }
}

TEST(Scene, ReadsAGarmentAndABodyFromFiles) {
  const std::filesystem::path data = PLEAT_SHARED_DATA;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no real data at " << data;
  const std::filesystem::path skirt = std::filesystem::absolute(data / "garments/diffcloth_skirt1252.obj");
  const SceneText text(R"({"garment": {"obj": {"file": ")" + skirt.string() + R"("}, "pins": {"above": 0.0}}})");
  EXPECT_EQ(load(text.path()).garment.vertex_count(), 681u);
}

// --- bad input ------------------------------------------------------------------------------------------------------

const std::string kGarment = R"("garment": {"grid": {"rows": 3, "columns": 3}})";

TEST(SceneFile, AcceptsTheSmallestScene) { EXPECT_EQ(SceneText("{" + kGarment + "}").complaint(), "accepted"); }

TEST(SceneFile, RefusesBadInputAndNamesFileAndKey) {
  const struct {
    std::string text, place, what;
  } cases[] = {
      {"", ":1: ", "JSON"},
      {"{\n\"rate\": 60,\n", ":3: ", "cut short"},
      {"[]", ": ", "should be an object"},
      {"{}", ": ", "`garment` is missing"},
      {"{" + kGarment + ", \"gravitas\": 1}", ": ", "unknown key `gravitas`; known are description, N, rate"},
      {"{" + kGarment + ", \"rate\": \"fast\"}", ": /rate: ", "should be a number"},
      {"{" + kGarment + ", \"rate\": 0}", ": /rate: ", "is 0"},
      {"{" + kGarment + ", \"rate\": NaN}", ":1: ", "JSON"},
      {"{" + kGarment + ", \"rate\": 1e999}", ": ", "JSON"},
      {"{" + kGarment + ",\n\"rate\": 1e999\n}", ":2: ", "JSON"},
      {"{" + kGarment + ",\n\"settings\": {\"density\": 1,\n\"density\": 2}}",
       ":3: ", "`density` stands here a second time"},
      {"{" + kGarment + ", \"N\": 3, \"x\": " + std::string(1000000, '[') + std::string(1000000, ']') + "}",
       ":1: ", "nested"},
      {"{" + kGarment + ", \"view\": [0, 0, 0]}", ": /view: ", "zero"},
      {"{" + kGarment + ", \"view\": [0, -1, 0]}", ": /view: ", "straight up or down"},
      {"{" + kGarment + ", \"frames\": 2.5}", ": /frames: ", "whole number"},
      {"{" + kGarment + ", \"frames\": -1}", ": /frames: ", "is -1"},
      {"{" + kGarment + ", \"gravity\": [0, 1]}", ": /gravity: ", "three numbers"},
      {"{" + kGarment + ", \"settings\": {\"stiffnes\": 3}}", ": /settings/stiffnes: ", "unknown setting"},
      {"{" + kGarment + ", \"settings\": {\"surface\": \"silk\"}}", ": /settings/surface: ", "flat, pn, paper, pleat"},
      {"{" + kGarment + ", \"settings\": {\"density\": true}}", ": /settings/density: ", "number or a text"},
      {"{" + kGarment + ", \"colliders\": [{\"cone\": {}}]}", ": /colliders/0: ", "unknown key `cone`"},
      {"{" + kGarment + ", \"colliders\": [{\"sphere\": {\"center\": [0,0,0], \"radius\": -1}}]}",
       ": /colliders/0/sphere/radius: ", "is -1"},
      {"{" + kGarment + ", \"colliders\": [{\"obj\": {\"file\": \"none.obj\"}}]}", "none.obj: ", "cannot be opened"},
      {"{" + kGarment + ", \"motion\": {\"clip\": {\"file\": \"none.bvh\"}}}", "none.bvh: ", "cannot be opened"},
      {"{" + kGarment + ", \"motion\": {}}", ": /motion: ", "kick, clip"},
      {R"({"garment": {"grid": {"rows": 0, "columns": 3}}})", ": /garment/grid/rows: ", "is 0"},
      {R"({"garment": {"grid": {"rows": 2000, "columns": 2500}}})", ": /garment/grid: ", "too large"},
      {R"({"garment": {"skirt": {"ring_sizes": [8, 8]}}})", ": /garment/skirt: ", "/motion/clip"},
      {R"({"garment": {"grid": {"rows": 3, "columns": 3}, "obj": {}}})", ": /garment: ", "both"},
      {R"({"garment": {"grid": {"rows": 3, "columns": 3}, "pins": {"vertices": [9]}}})",
       ": /garment/pins/vertices/0: ", "is 9"},
      {R"({"garment": {"grid": {"rows": 3, "columns": 3}, "pins": {"vertices": [1, 1]}}})",
       ": /garment/pins/vertices: ", "twice"},
      {R"({"garment": {"grid": {"rows": 3, "columns": 3}, "pins": {"above": 5}}})", ": /garment/pins: ", "no vertex"},
      {R"({"garment": {"grid": {"rows": 3, "columns": 3}, "pins": {"ring": 0}}})", ": /garment/pins/ring: ", "rings"},
  };
  for (const auto& [text, place, what] : cases) {
    const SceneText file(text);
    const std::string said = file.complaint();
    EXPECT_NE(said.find(place), std::string::npos) << said;
    EXPECT_NE(said.find(what), std::string::npos) << said;
    EXPECT_NE(said.find(std::filesystem::path(place.find("none.") == 0 ? "none." : file.path()).filename().string()),
              std::string::npos)
        << said;
  }
}

TEST(SceneFile, WhatTheEngineRefusesNamesTheField) {
  const SceneText text("{" + kGarment + ", \"settings\": {\"density\": -1}}");
  try {
    Scene scene(api(), load(text.path()));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("density"), std::string::npos) << error.what();
  }
}

TEST(SceneFile, NamesAndSizes) {
  EXPECT_THROW(load("no_such_scene"), InputError);
  EXPECT_THROW(load("skirt_kick:8"), InputError) << "has no size";
  for (const char* size : {"0", "-3", "x", "", "99999999999", "4x"}) {
    EXPECT_THROW(load(std::string("hanging_square:") + size), InputError) << size;
  }
  EXPECT_THROW(load("hanging_square:1"), InputError);
  EXPECT_THROW(load("hanging_square:3000"), InputError) << "18 million triangles";
}

TEST(SceneFile, ATruncatedClipIsRefused) {
  const std::string path = testing::TempDir() + "truncated.bvh";
  std::ofstream(path) << "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n";
  SceneRequest request;
  request.clip = path;
  try {
    load_scene(api(), request);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path, 0), 0u) << error.what();
  }
  request.scene = "skirt_kick";
  EXPECT_THROW(load_scene(api(), request), InputError) << "plays no clip";
  std::filesystem::remove(path);
}

TEST(SceneFile, AKeyMayStandInSeveralObjects) {
  const std::string ball = R"({"sphere": {"center": [0, 0, 0], "radius": 1}})";
  EXPECT_EQ(SceneText("{" + kGarment + ", \"colliders\": [" + ball + ", " + ball + "]}").complaint(), "accepted");
}

TEST(SceneFile, AMotionWithoutEndIsRefusedUnlessFramesAreSaid) {
  std::string clip(load_shipped("kick.bvh"));
  const size_t time = clip.find("Frame Time:");
  clip.replace(time, clip.find('\n', time) - time, "Frame Time: 1e6");
  const std::string path = testing::TempDir() + "endless.bvh";
  std::ofstream(path) << clip;
  SceneRequest request;
  request.clip = path;
  EXPECT_THROW(load_scene(api(), request), InputError);
  request.frames = 2;
  EXPECT_EQ(load_scene(api(), request).frames, 2u);
  std::filesystem::remove(path);
}

TEST(SceneAir, GustsAndFabricsAreReadAndChecked) {
  const std::string grid = R"("garment": {"grid": {"rows": 3, "columns": 3}, "pins": {"vertices": [0, 2]}})";
  const SceneText good("{" + grid + R"(, "fabric": "denim", "settings": {"density": 0.5},
                        "gust": {"speed": 3, "frequency": 0.5, "seed": 7}})");
  const SceneDef def = load(good.path());
  EXPECT_EQ(def.settings.density, 0.5f);
  EXPECT_NEAR(def.settings.stiffness, 545.6f, 0.1f);
  EXPECT_EQ(def.settings.bend_stiffness, 70e-6f);
  EXPECT_EQ(def.gust, 3.0);
  EXPECT_EQ(def.gust_frequency, 0.5);
  EXPECT_EQ(def.gust_seed, 7u);

  const std::pair<const char*, const char*> bad[] = {{R"("fabric": "tin")", "/fabric: unknown fabric `tin`"},
                                                     {R"("fabric": 3)", "/fabric"},
                                                     {R"("gust": {"seed": 1})", "/gust"},
                                                     {R"("gust": {"speed": -1})", "/gust/speed"},
                                                     {R"("gust": {"speed": 1, "sped": 2})", "sped"}};
  for (const auto& [key, said] : bad) {
    const SceneText scene("{" + grid + ", " + key + "}");
    EXPECT_NE(scene.complaint().find(said), std::string::npos) << scene.complaint();
  }
}

TEST(Scene, ABudgetThatIsTooSmallTakesDetailFromAllButNoneWithout) {
  SceneDef def = load("crowd:3");
  for (const double budget : {0.0, 1e-6}) {
    def.budget = budget;
    Scene scene(api(), def);
    for (int frame = 0; frame < 10; ++frame) scene.advance();
    EXPECT_EQ(scene.stats().folds_given_up, budget == 0.0 ? 0u : 3u);
  }
}

}  // namespace
}  // namespace pleat::demo
