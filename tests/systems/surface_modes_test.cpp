// How well each way to curve a triangle follows a known surface, from points and normals that lie on it exactly.
#include <gtest/gtest.h>

#include <functional>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

/// The graph or tube of a known surface over x, z: its point and normal, and the distance of any point near it.
struct Known {
  std::function<Vec3(float, float)> point, normal;
  std::function<double(const Vec3&)> distance;
};

const Known kCylinder{[](float x, float z) {
                        return Vec3{std::sin(x), std::cos(x), z};
                      },
                      [](float x, float) {
                        return Vec3{std::sin(x), std::cos(x), 0.0f};
                      },
                      [](const Vec3& p) { return std::hypot(double{p.x}, double{p.y}) - 1.0; }};

const Known kSphere{[](float x, float z) {
                      return Vec3{x, std::sqrt(1.0f - x * x - z * z), z};
                    },
                    [](float x, float z) {
                      return Vec3{x, std::sqrt(1.0f - x * x - z * z), z};
                    },
                    [](const Vec3& p) { return static_cast<double>(length(p)) - 1.0; }};

const Known kSaddle{[](float x, float z) {
                      return Vec3{x, x * z, z};
                    },
                    [](float x, float z) {
                      const Vec3 n{-z, 1.0f, -x};
                      return n * (1.0f / length(n));
                    },
                    [](const Vec3& p) {  // to first order
                      return static_cast<double>((p.y - p.x * p.z) / std::sqrt(1.0f + p.x * p.x + p.z * p.z));
                    }};

/// RMS distance of the drawn surface from the known one over the length of an edge; a patch of equilateral triangles.
double error(const Known& known, SurfaceMode mode, float edge) {
  Surface s(make_grid({.rows = 3, .columns = 3, .width = 2 * edge, .depth = 2 * edge}), 8);
  s.mode = mode;
  for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) {
    const Vec3 rest = s.garment.rest_position.view()[i];
    const float x = rest.x - 0.5f * rest.z, z = 0.8660254f * rest.z;
    s.position.view().set(i, known.point(x, z));
    s.normal.view().set(i, known.normal(x, z));
  }
  s.tessellation().run();
  double sum = 0.0;
  for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) sum += std::pow(known.distance(s.drawn.view()[i]), 2);
  return std::sqrt(sum / s.pattern.vertex_count) / static_cast<double>(edge);
}

TEST(SurfaceModes, ErrorsAreThoseOfTheLiterature) {
  const struct {
    const Known& known;
    float edge;
    double flat, pn, phong;
  } rows[] = {{kCylinder, 0.8f, 5.3e-2, 4.5e-3, 1.9e-2}, {kCylinder, 0.4f, 2.7e-2, 5.8e-4, 1.2e-2}};
  for (const auto& row : rows) {
    EXPECT_NEAR(error(row.known, SurfaceMode::kFlat, row.edge) / row.flat, 1.0, 0.1);
    EXPECT_NEAR(error(row.known, SurfaceMode::kPn, row.edge) / row.pn, 1.0, 0.15);
    EXPECT_NEAR(error(row.known, SurfaceMode::kPhong, row.edge) / row.phong, 1.0, 0.15);
    EXPECT_LT(error(row.known, SurfaceMode::kArcPn, row.edge), 0.2 * row.pn);
  }
}

TEST(SurfaceModes, SpherigonIsExactOnSpheresAndCylinders) {
  for (const float edge : {0.1f, 0.4f}) {
    EXPECT_LT(error(kSphere, SurfaceMode::kSpherigon, edge), 1e-6);
    EXPECT_LT(error(kCylinder, SurfaceMode::kSpherigon, edge), 1e-6);
  }
}

TEST(SurfaceModes, OrdersOfConvergence) {
  // The distance falls by 2^order when the edge is halved; `error` is over the edge.
  const auto order = [](const Known& known, SurfaceMode mode) {
    return std::log2(error(known, mode, 0.2f) / error(known, mode, 0.1f)) + 1.0;
  };
  for (const Known* known : {&kCylinder, &kSphere}) {
    EXPECT_NEAR(order(*known, SurfaceMode::kFlat), 2.0, 0.1);
    EXPECT_NEAR(order(*known, SurfaceMode::kPhong), 2.0, 0.1);
    EXPECT_NEAR(order(*known, SurfaceMode::kPn), 4.0, 0.2);
    EXPECT_NEAR(order(*known, SurfaceMode::kArcPn), 4.0, 0.5);
  }
}

TEST(SurfaceModes, CurvedTrianglesFollowASaddle) {
  const double flat = error(kSaddle, SurfaceMode::kFlat, 0.4f);
  for (const SurfaceMode mode : {SurfaceMode::kPn, SurfaceMode::kArcPn, SurfaceMode::kSpherigon}) {
    EXPECT_LT(error(kSaddle, mode, 0.4f), 0.05 * flat);
  }
  EXPECT_LT(error(kSaddle, SurfaceMode::kPhong, 0.4f), 0.6 * flat);
}

void expect_finite(const Mesh& mesh) {
  for (std::uint32_t mode = 0; mode <= static_cast<std::uint32_t>(SurfaceMode::kArcPn); ++mode) {
    Surface s(mesh, 3);
    s.mode = static_cast<SurfaceMode>(mode);
    s.run();
    std::uint32_t not_finite = 0;
    for (std::uint32_t i = 0; i < s.garment.normal_count; ++i) not_finite += !is_finite(s.normal.view()[i]);
    for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
      not_finite += !is_finite(s.fold.view()[e]) || !std::isfinite(s.fold_height[e]) ||
                    !std::isfinite(s.fold_side[e]) || !std::isfinite(s.garment.edge_rest_curve_length[e]);
    }
    for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) not_finite += !is_finite(s.drawn.view()[v]);
    for (std::uint32_t v = 0; v < s.pattern.shaded_count(); ++v) not_finite += !is_finite(s.drawn_normal.view()[v]);
    EXPECT_EQ(not_finite, 0u) << mode;
  }
}

TEST(SurfaceModes, ATinyTriangleIsDrawnFinite) {
  // The sides' squares multiplied are less than the least float.
  for (const float size : {1e-5f, 1e-6f, 2e-7f, 1e-7f}) {
    Mesh mesh = sheet(5);
    const Vec3 corner = mesh.positions.back();
    for (Vec3& x : mesh.positions) x -= corner;
    const auto at = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({size, 0, size});
    mesh.positions.push_back({0, 0, size});
    mesh.triangles.push_back({at - 1, at, at + 1});
    for (Vec3& x : mesh.positions) x = {0.8f * x.x - 0.6f * x.z, 0.36f * x.x + 0.48f * x.z, 0.48f * x.x + 0.64f * x.z};
    expect_finite(mesh);
  }
}

TEST(SurfaceModes, ATinyGarmentIsDrawnFinite) {
  for (const float size : {1e-6f, 1e-7f, 1e-8f, 1e-9f, 1e-10f}) {
    Mesh mesh = sheet(5);
    for (Vec3& x : mesh.positions) x = x * size;
    expect_finite(mesh);
  }
}

}  // namespace
}  // namespace pleat
