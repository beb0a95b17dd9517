#include "systems/particle_normals.h"

#include <gtest/gtest.h>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

/// Eqs (1), (3), (4) written out per particle, in double precision.
Vec3 paper_normal(const Surface& s, std::uint32_t i) {
  const Garment& g = s.garment;
  const ConstVec3View x = s.position.view();
  Vec3T<double> sum;
  for (std::uint32_t at = g.around_begin[i]; at < g.around_begin[i + 1]; ++at) {
    const std::uint32_t f = g.faces_around[at];
    std::uint32_t k = 0;
    while (g.face_particle[k][f] != i) ++k;
    const auto point = [&](std::uint32_t c) {
      const Vec3 p = x[g.face_particle[(k + c) % 3][f]];
      return Vec3T<double>{p.x, p.y, p.z};
    };
    const auto force = [&](std::uint32_t c, std::uint32_t edge) {
      const Vec3T<double> d = point(c) - point(0);
      const double rest = g.edge_rest_length[g.face_edge[edge][f]], l = length(d);
      return d * (1.0 / l) * (l / rest * (l - rest));
    };
    const Vec3T<double> normal = cross(point(1) - point(0), point(2) - point(0));
    sum += normal * (1.0 / length(normal)) * length(force(1, k) + force(2, (k + 2) % 3));
  }
  const Vec3T<double> n = sum * (1.0 / length(sum));
  return {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
}

TEST(ParticleNormals, PaperModeIsEquationThree) {
  Surface s(skirt());
  s.mode = SurfaceMode::kPaper;
  s.jitter(0.03f, 1);
  s.particle_normals().run();
  for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) {
    EXPECT_LT(length(std::as_const(s.normal).view()[i] - paper_normal(s, i)), 2e-5f);
  }
}

TEST(ParticleNormals, WithoutForcesAllModesGiveTheBaseNormal) {
  Surface s(skirt());
  s.mode = SurfaceMode::kPn;
  s.particle_normals().run();
  std::vector<Vec3> base;
  for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) base.push_back(s.normal.view()[i]);
  for (const SurfaceMode mode : {SurfaceMode::kFlat, SurfaceMode::kPleat, SurfaceMode::kPaper}) {
    s.mode = mode;
    s.particle_normals().run();
    for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) {
      if (mode == SurfaceMode::kPaper) {
        EXPECT_LT(length(s.normal.view()[i] - base[i]), 1e-6f);
      } else {
        EXPECT_EQ(s.normal.view()[i], base[i]);
      }
    }
  }
}

TEST(ParticleNormals, BaseNormalsDoNotFavourTheSideWithMoreFaces) {
  // Two slopes meet in a ridge; at its middle point 3 there are two faces on the left and four on the right, where a
  // plain average would lean over by 0.32.
  const Mesh roof{
      {{-1, -1, 0}, {-1, -1, 1}, {0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, -1, 0}, {1, -1, 1}, {1, -1, 2}, {-1, -1, 2}},
      {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}, {1, 8, 4}, {2, 3, 5}, {3, 6, 5}, {3, 4, 7}, {3, 7, 6}}};
  Surface s(roof);
  s.mode = SurfaceMode::kPn;
  s.particle_normals().run();
  EXPECT_LT(length(s.normal.view()[3] - Vec3{0, 1, 0}), 1e-6f);
}

TEST(ParticleNormals, OnASphereBaseNormalsAreRadial) {
  // A vertex and any star of neighbours on a sphere: Max's weights are exact there.
  Mesh star;
  star.positions.push_back({0, 1, 0});
  const float angle[] = {0.0f, 0.5f, 1.4f, 2.0f, 3.5f, 4.4f};
  const float polar[] = {0.3f, 0.6f, 0.2f, 0.5f, 0.4f, 0.7f};
  for (int i = 0; i < 6; ++i) {
    const float sp = std::sin(polar[i]);
    star.positions.push_back({sp * std::sin(angle[i]), std::cos(polar[i]), sp * std::cos(angle[i])});
  }
  for (std::uint32_t i = 0; i < 6; ++i) star.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
  Surface s(star);
  s.particle_normals().run();
  EXPECT_LT(length(s.normal.view()[0] - Vec3{0, 1, 0}), 1e-5f);
}

TEST(ParticleNormals, PleatIsCalmWhereForcesAreNoise) {
  const auto largest_turn = [](SurfaceMode mode) {
    Surface a(skirt()), b(skirt());
    a.mode = b.mode = mode;
    a.jitter(1e-5f, 1), b.jitter(1e-5f, 2);  // a tenth of a millimetre of an edge, give or take
    a.particle_normals().run(), b.particle_normals().run();
    float turn = 0.0f;
    for (std::uint32_t i = 0; i < a.garment.particle_count; ++i) {
      turn = std::max(turn, length(a.normal.view()[i] - b.normal.view()[i]));
    }
    return turn;
  };
  EXPECT_LT(largest_turn(SurfaceMode::kPleat), 2e-3f);
  EXPECT_GT(largest_turn(SurfaceMode::kPaper), 0.1f);  // the defect that the force floor removes
}

/// A sheet of n x n in waves along x, z = A sin(k x), bent without stretch: its particles, and how steep it is there.
struct Waves {
  Surface surface;
  std::vector<Vec3> truth;

  Waves(std::uint32_t n, float amplitude, float k) : surface(sheet(n)) {
    surface.move([&](const Vec3& rest) {
      constexpr int kSteps = 2000;
      double x = 0.0;  // with as much cloth between 0 and x as at rest
      for (int step = 0; step < kSteps; ++step) {
        x += static_cast<double>(rest.x) / kSteps / std::hypot(1.0, amplitude * k * std::cos(k * x));
      }
      const float at = static_cast<float>(x);
      const Vec3 normal{-amplitude * k * std::cos(k * at), 1.0f, 0.0f};
      truth.push_back(normal * (1.0f / length(normal)));
      return Vec3{at, amplitude * std::sin(k * at), rest.z};
    });
  }
  double error(SurfaceMode mode) {
    surface.mode = mode;
    surface.particle_normals().run();
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const auto turn = static_cast<double>(length(surface.normal.view()[i] - truth[i]));
      sum += turn * turn;
    }
    return std::sqrt(sum / static_cast<double>(truth.size()));
  }
};

TEST(ParticleNormals, ShortEdgesBringPleatCloserToAWavingSheet) {
  for (const float k : {12.0f, 16.0f, 24.0f}) {  // 8.4, 6.3 and 4.2 edges a wave
    Waves waves(17, 1.0f / k, k);
    EXPECT_LT(waves.error(SurfaceMode::kPleat), 0.75 * waves.error(SurfaceMode::kPn)) << k;
  }
}

TEST(ParticleNormals, PleatIsTheBaseNormalWhereNoEdgeIsShort) {
  Surface s(skirt());
  s.move([](const Vec3& x) { return x * 1.1f; });
  s.jitter(0.002f, 3);
  s.mode = SurfaceMode::kPn;
  s.particle_normals().run();
  std::vector<Vec3> base;
  for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) base.push_back(s.normal.view()[i]);
  s.mode = SurfaceMode::kPleat;
  s.particle_normals().run();
  for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) EXPECT_EQ(s.normal.view()[i], base[i]);
}

TEST(ParticleNormals, DegenerateClothHasFiniteUnitNormals) {
  for (const SurfaceMode mode : {SurfaceMode::kPn, SurfaceMode::kPaper, SurfaceMode::kPleat}) {
    for (const float scale : {0.0f, 1e-12f, 1e-6f}) {
      Surface s(skirt());
      s.mode = mode;
      s.move([&](const Vec3& x) { return Vec3{x.x * scale, x.y * scale, 0.0f}; });  // a point, or folded flat
      s.particle_normals().run();
      for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) EXPECT_NEAR(length(s.normal.view()[i]), 1.0f, 1e-5f);
    }
  }
}

TEST(ParticleNormals, ValidateRefusesWhatIsMissing) {
  Surface s(skirt());
  EXPECT_TRUE(s.particle_normals().validate());
  ParticleNormals p = s.particle_normals();
  p.garment = nullptr;
  EXPECT_FALSE(p.validate());
  p = s.particle_normals(), p.position = {};
  EXPECT_FALSE(p.validate());
  p = s.particle_normals(), p.sum = nullptr;
  EXPECT_FALSE(p.validate());
  p = s.particle_normals(), p.place = nullptr;
  EXPECT_FALSE(p.validate());
  p = s.particle_normals(), p.normal = {};
  EXPECT_FALSE(p.validate());
  p = s.particle_normals(), p.mode = static_cast<SurfaceMode>(7);
  EXPECT_FALSE(p.validate());
}

}  // namespace
}  // namespace pleat
