#include "demo/quality/quality.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace pleat::demo {
namespace {

TEST(Distance, PointToCapsuleIsExact) {
  const ExactCapsule capsule{{0, 0, 0}, {0, 1, 0}, 0.1};
  EXPECT_DOUBLE_EQ(signed_distance(Vector3d(0.3, 0.5, 0), capsule), 0.2);
  EXPECT_DOUBLE_EQ(signed_distance(Vector3d(0, 0.5, 0), capsule), -0.1);
  EXPECT_NEAR(signed_distance(Vector3d(0, 1.25, 0), capsule), 0.15, 1e-15);
  EXPECT_NEAR(signed_distance(Vector3d(0.03, -0.04, 0), {{0, 0, 0}, {0, 0, 0}, 0.1}), -0.05, 1e-15);
}

TEST(Distance, TriangleSeesACapsuleThatPassesBetweenItsCorners) {
  const Triangle triangle{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
  EXPECT_DOUBLE_EQ(signed_distance(triangle, {{0, -1, 0}, {0, 1, 0}, 0.05}), -0.05);             // pierced
  EXPECT_NEAR(signed_distance(triangle, {{0, 0.04, 0}, {0, 1, 0}, 0.05}), -0.01, 1e-15);         // end inside a face
  EXPECT_NEAR(signed_distance(triangle, {{-2, 0.3, -1.4}, {2, 0.3, -1.4}, 0.05}), 0.45, 1e-12);  // along an edge
  EXPECT_NEAR(signed_distance(triangle, {{0, 0.2, 3}, {0, 0.2, 1}, 0.05}), 0.15, 1e-12);         // beyond a corner
}

TEST(Distance, TriangleAgreesWithDenseSamples) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  for (int trial = 0; trial < 200; ++trial) {
    const Triangle t{point(), point(), point()};
    const ExactCapsule capsule{point(), point(), 0.0};
    double sampled = 1e9;
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        sampled = std::min(sampled, signed_distance((i * t.a + j * t.b + (kSteps - i - j) * t.c) / kSteps, capsule));
      }
    }
    const double exact = signed_distance(t, capsule);
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_NEAR(exact, sampled, 0.05);
  }
}

/// The cube [-.5, .5]^3.
const std::vector<float> kCube = {-.5f, -.5f, -.5f, .5f, -.5f, -.5f, .5f, .5f, -.5f, -.5f, .5f, -.5f,
                                  -.5f, -.5f, .5f,  .5f, -.5f, .5f,  .5f, .5f, .5f,  -.5f, .5f, .5f};
const std::vector<uint32_t> kCubeFaces = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                          3, 7, 6, 3, 6, 2, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};

TEST(SolidMesh, SignedDistanceOfACube) {
  const SolidMesh cube(kCube, kCubeFaces);
  EXPECT_NEAR(cube.signed_distance({0, 0, 0}), -0.5, 1e-12);
  EXPECT_NEAR(cube.signed_distance({0.4, 0.1, -0.2}), -0.1, 1e-7);
  EXPECT_NEAR(cube.signed_distance({0.9, 0.1, -0.2}), 0.4, 1e-7);
  EXPECT_NEAR(cube.signed_distance({1.5, 1.5, 0.2}), std::sqrt(2.0), 1e-7);  // an edge is nearest
  EXPECT_NEAR(cube.signed_distance({1.5, 1.5, 1.5}), std::sqrt(3.0), 1e-7);  // a corner is nearest
}

TEST(SolidMesh, SignIsRightEverywhereAroundACube) {
  const SolidMesh cube(kCube, kCubeFaces);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3d p(uniform(random), uniform(random), uniform(random));
    const Vector3d beyond = p.cwiseAbs() - Vector3d::Constant(0.5);
    const double expected = beyond.maxCoeff() < 0 ? beyond.maxCoeff() : beyond.cwiseMax(0.0).norm();
    EXPECT_NEAR(cube.signed_distance(p), expected, 1e-7) << p.transpose();
  }
}

/// A right triangle with sides 3, 4 and 5 m at rest: edges 01, 02, 12.
const ClothMesh kTriangle{{0, 1, 0, 2, 1, 2}, {3.0f, 4.0f, 5.0f}, {0, 1, 2}, {true, false, false}};

TEST(Quality, StrainOfAKnownStretch) {
  QualityMeter meter;
  meter.begin_frame();  // 01 is 10 % long, 02 20 % short
  const std::array<float, 9> particles = {0, 0, 0, 3.3f, 0, 0, 0, 0, 3.2f};
  meter.add_cloth(kTriangle, {particles, particles, kTriangle.triangles}, {});
  meter.begin_frame();
  const std::array<float, 9> rest = {0, 0, 0, 3, 0, 0, 0, 0, 4};
  meter.add_cloth(kTriangle, {rest, rest, kTriangle.triangles}, {});
  const Quality quality = meter.result();
  const double third = std::hypot(3.3, 3.2) / 5.0 - 1.0;  // 12 is short too
  EXPECT_NEAR(quality.strain_max_percent, 10.0, 1e-4);
  EXPECT_NEAR(quality.strain_p99_percent, 10.0, 1e-4);
  EXPECT_NEAR(quality.strain_rms_percent, 100.0 * std::sqrt((0.01 + 0.04 + third * third) / 6.0), 1e-4);
  EXPECT_NEAR(quality.stretch_rms_percent, 10.0, 1e-4) << "only one edge is elongated";
  EXPECT_FALSE(quality.penetration_particle_mm) << "no body, nothing measured";
  EXPECT_FALSE(quality.rest_jitter_mm);
}

TEST(Quality, NinetyNinthPercentileDropsTheOneWorstOfTwoHundredFrames) {
  QualityMeter meter;
  for (int frame = 0; frame < 200; ++frame) {
    meter.begin_frame();
    const float length = frame == 50 ? 2.0f : frame == 60 ? 1.5f : 1.02f;
    const std::array<float, 9> particles = {0, 0, 0, length, 0, 0, 0, 0, 1};
    const ClothMesh one_edge{{0, 1}, {1.0f}, {}, {true, false, false}};
    meter.add_cloth(one_edge, {particles, particles, {}}, {});
  }
  EXPECT_NEAR(meter.result().strain_max_percent, 100.0, 1e-4);
  EXPECT_NEAR(meter.result().strain_p99_percent, 2.0, 1e-4);
}

TEST(Quality, ALegThroughAFaceIsSeenOnlyInTheInterior) {
  const ClothMesh mesh{{}, {}, {0, 1, 2}, {false, false, false}};
  const std::array<float, 9> particles = {-.15f, 0, -.15f, .15f, 0, -.15f, 0, 0, .3f};  // its centroid is the origin
  const std::array<float, 9> lifted = {-.15f, .04f, -.15f, .15f, .04f, -.15f, 0, .04f, .3f};
  QualityMeter meter;
  meter.begin_frame();
  meter.add_cloth(mesh, {particles, lifted, mesh.triangles}, {{{{0, -1, 0}, {0, 0, 0}, 0.075}}, {}});
  const Quality quality = meter.result();
  EXPECT_EQ(quality.penetration_particle_mm, 0.0);
  EXPECT_NEAR(*quality.penetration_drawn_mm, 35.0, 1e-3);
  EXPECT_GT(*quality.penetration_interior_mm, 0.0);
  EXPECT_LE(*quality.penetration_interior_mm, 75.0 + 1e-9);
}

TEST(Quality, DepthInAMeshBody) {
  const ClothMesh mesh{{}, {}, {0, 1, 2}, {false, false, false}};
  const std::array<float, 9> particles = {0.1f, 0.4f, 0.1f, 2, 0.4f, 0, 0, 0.4f, 2};
  QualityMeter meter;
  meter.begin_frame();
  meter.add_cloth(mesh, {particles, particles, mesh.triangles}, {{}, {std::make_shared<SolidMesh>(kCube, kCubeFaces)}});
  EXPECT_NEAR(*meter.result().penetration_particle_mm, 100.0, 1e-3);
  EXPECT_NEAR(*meter.result().penetration_drawn_mm, 100.0, 1e-3);
}

TEST(Quality, RestJitterAndSpeedCountFreeParticlesOnly) {
  QualityMeter meter;
  const std::array<float, 9> before = {0, 0, 0, 0, 0, 0, 0, 0, 0};
  const std::array<float, 9> after = {9, 9, 9, 0.003f, 0, 0, 0, 0.004f, 0};
  meter.add_rest_motion(kTriangle, before, after, 0.1);
  EXPECT_NEAR(*meter.result().rest_jitter_mm, std::sqrt((9.0 + 16.0) / 2.0), 1e-5);
  EXPECT_NEAR(*meter.result().rest_speed_cm_s, 4.0, 1e-5);
}

}  // namespace
}  // namespace pleat::demo
