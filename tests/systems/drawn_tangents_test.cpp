#include "systems/drawn_tangents.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

using Texture = std::function<std::array<float, 2>(const Vec3&)>;

struct TangentSurface {
  Surface surface;
  Vec3Column tangent{std::pmr::new_delete_resource()};
  Column<float> handedness{std::pmr::new_delete_resource()};

  static Garment cut(const Mesh& mesh, const Texture& texture, float crease_angle) {
    std::vector<float> uvs;
    for (const Vec3& x : mesh.positions) {
      const auto [u, v] = texture(x);
      uvs.push_back(u), uvs.push_back(v);
    }
    return garment_of(mesh, crease_angle, uvs);
  }
  TangentSurface(const Mesh& mesh, const Texture& texture, std::uint32_t level = 0, float crease_angle = 4.0f)
      : surface(texture ? cut(mesh, texture, crease_angle) : garment_of(mesh, crease_angle), level) {
    tangent.resize(surface.pattern.shaded_count());
    handedness.resize(surface.pattern.shaded_count());
  }
  DrawnTangents system() {
    return {&surface.garment, &surface.pattern, surface.drawn.view(), surface.drawn_normal.view(),
            tangent.view(),   handedness.data()};
  }
  void run() {
    surface.run();
    system().run();
  }
  void expect_sound() {
    for (std::uint32_t i = 0; i < surface.pattern.shaded_count(); ++i) {
      EXPECT_NEAR(length(tangent.view()[i]), 1.0f, 1e-5f);
      EXPECT_NEAR(dot(tangent.view()[i], surface.drawn_normal.view()[i]), 0.0f, 1e-4f);
      EXPECT_EQ(std::abs(handedness[i]), 1.0f);
    }
  }
};

TEST(DrawnTangents, FollowUOnAFlatSheetWhateverTheTexturesScaleAndTurn) {
  const float c = std::cos(0.7f), q = std::sin(0.7f);
  const struct {
    Texture texture;
    Vec3 tangent;
    float handedness;
  } cases[] = {{[](const Vec3& x) {
                  return std::array{x.x, -x.z};
                },
                {1, 0, 0},
                1.0f},
               {[](const Vec3& x) {
                  return std::array{x.x, x.z};
                },
                {1, 0, 0},
                -1.0f},
               {[](const Vec3& x) {
                  return std::array{-x.x, -x.z};
                },
                {-1, 0, 0},
                -1.0f},
               {[](const Vec3& x) {
                  return std::array{1e-3f * x.x, -1e3f * x.z};
                },
                {1, 0, 0},
                1.0f},
               {[=](const Vec3& x) {
                  return std::array{c * x.x + q * x.z, q * x.x - c * x.z};
                },
                {c, 0, q},
                1.0f}};
  for (const auto& test : cases) {
    for (const std::uint32_t level : {0u, 3u}) {
      TangentSurface s(sheet(4), test.texture, level);
      s.run();
      for (std::uint32_t i = 0; i < s.surface.pattern.vertex_count; ++i) {
        EXPECT_LT(length(s.tangent.view()[i] - test.tangent), 1e-4f);
        EXPECT_EQ(s.handedness[i], test.handedness);
        // What the header promises of v.
        const Vec3 along_v = cross(s.surface.drawn_normal.view()[i], s.tangent.view()[i]) * s.handedness[i];
        const auto a = test.texture({}), b = test.texture(along_v);
        EXPECT_GT(b[1] - a[1], 0.0f);
      }
    }
  }
}

TEST(DrawnTangents, GoAroundATube) {
  // A half tube, so that the texture has no cut: u is the angle.
  Mesh mesh = make_grid({.rows = 5, .columns = 17});
  const auto angle = [](const Vec3& x) { return 3.0f * x.x; };
  TangentSurface s(
      mesh,
      [&](const Vec3& x) {
        return std::array{angle(x), x.z};
      },
      4);
  s.surface.move([&](const Vec3& x) { return Vec3{std::sin(angle(x)) / 3.0f, std::cos(angle(x)) / 3.0f, x.z}; });
  s.run();
  for (std::uint32_t i = 0; i < s.surface.pattern.vertex_count; ++i) {
    const Vec3 x = s.surface.drawn.view()[i], around = normalized_or(Vec3{x.y, -x.x, 0.0f}, {});
    EXPECT_GT(dot(s.tangent.view()[i], around), 0.995f);
  }
}

TEST(DrawnTangents, AreSoundOnCrumpledClothWithAndWithoutATexture) {
  const Texture textures[] = {{},
                              [](const Vec3& x) {
                                return std::array{x.x, x.y};
                              },  // mirrored on the back
                              [](const Vec3&) {
                                return std::array{0.5f, 0.5f};
                              }};
  for (const Texture& texture : textures) {
    TangentSurface s(skirt(), texture);
    s.surface.jitter(0.03f, 3);
    s.run();
    s.expect_sound();
    s.surface.move([](const Vec3& x) { return Vec3{x.x, 0.0f, 0.0f}; });  // collapsed to a line
    s.run();
    for (std::uint32_t i = 0; i < s.surface.pattern.vertex_count; ++i) EXPECT_TRUE(is_finite(s.tangent.view()[i]));
    s.expect_sound();
  }
}

TEST(DrawnTangents, WithoutATextureTheyAreNearestToTheXAxis) {
  TangentSurface s(sheet(3), {});
  s.run();
  for (std::uint32_t i = 0; i < s.surface.pattern.vertex_count; ++i) EXPECT_EQ(s.tangent.view()[i], (Vec3{1, 0, 0}));
}

TEST(DrawnTangents, ValidateRefusesWhatIsMissing) {
  TangentSurface s(sheet(3), {});
  EXPECT_TRUE(s.system().validate());
  DrawnTangents t = s.system();
  t.garment = nullptr;
  EXPECT_FALSE(t.validate());
  t = s.system(), t.pattern = nullptr;
  EXPECT_FALSE(t.validate());
  t = s.system(), t.position = {};
  EXPECT_FALSE(t.validate());
  t = s.system(), t.normal = {};
  EXPECT_FALSE(t.validate());
  t = s.system(), t.tangent = {};
  EXPECT_FALSE(t.validate());
  t = s.system(), t.handedness = nullptr;
  EXPECT_FALSE(t.validate());
}

}  // namespace
}  // namespace pleat
