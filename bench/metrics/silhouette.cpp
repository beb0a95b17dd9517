#include "bench/metrics/silhouette.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bench/metrics/area_samples.h"

namespace pleat::bench {
namespace {

using demo::Vector3d;
using Eigen::Vector2d;

constexpr int kViews = 8;
constexpr double kFromAbove = 20.0 * std::numbers::pi / 180.0;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Pixel (i, j) has its middle at (i + .5, j + .5).
void cover(const std::array<Vector2d, 3>& t, Silhouette& picture) {
  const double area = cross(t[1] - t[0], t[2] - t[0]);
  if (area == 0.0) return;
  const Vector2d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  const auto first = [](double x) { return std::max(0, int(std::ceil(x - 0.5))); };
  const auto last = [&](double x) { return std::min(int(picture.size) - 1, int(std::floor(x - 0.5))); };
  for (int j = first(low.y()); j <= last(high.y()); ++j) {
    for (int i = first(low.x()); i <= last(high.x()); ++i) {
      const Vector2d middle(i + 0.5, j + 0.5);
      bool inside = true;
      for (size_t k = 0; k < 3; ++k) inside = inside && cross(t[(k + 1) % 3] - t[k], middle - t[k]) * area >= 0.0;
      if (inside) picture.covered[size_t(j) * picture.size + size_t(i)] = true;
    }
  }
}

}  // namespace

Silhouette draw_silhouette(const demo::TriangleMesh& mesh, const SilhouetteView& view, uint32_t size) {
  Silhouette picture{size, std::vector<bool>(size_t{size} * size)};
  const double pixels = size / view.width;
  const auto seen = [&](const Vector3d& p) {
    const Vector3d from_centre = p - view.centre;
    return Vector2d(0.5 * size + pixels * from_centre.dot(view.right), 0.5 * size - pixels * from_centre.dot(view.up));
  };
  for (size_t t = 0; t < mesh.triangle_count(); ++t) {
    const demo::Triangle face = triangle(mesh, t);
    cover({seen(face.a), seen(face.b), seen(face.c)}, picture);
  }
  return picture;
}

double silhouette_overlap(const demo::TriangleMesh& a, const demo::TriangleMesh& b, uint32_t size) {
  Vector3d low = corner(a, a.triangles[0]), high = low;
  for (const demo::TriangleMesh* mesh : {&a, &b}) {
    for (const uint32_t vertex : mesh->triangles) {
      low = low.cwiseMin(corner(*mesh, vertex));
      high = high.cwiseMax(corner(*mesh, vertex));
    }
  }
  SilhouetteView view{{}, {}, 0.5 * (low + high), 1.01 * (high - low).norm()};
  double sum = 0.0;
  for (int k = 0; k < kViews; ++k) {
    const double yaw = 2.0 * std::numbers::pi * k / kViews;
    const Vector3d away(std::sin(yaw), 0.0, std::cos(yaw));
    view.right = {std::cos(yaw), 0.0, -std::sin(yaw)};
    view.up = std::cos(kFromAbove) * Vector3d::UnitY() - std::sin(kFromAbove) * away;
    const Silhouette of_a = draw_silhouette(a, view, size), of_b = draw_silhouette(b, view, size);
    size_t both = 0, either = 0;
    for (size_t i = 0; i < of_a.covered.size(); ++i) {
      both += of_a.covered[i] && of_b.covered[i];
      either += of_a.covered[i] || of_b.covered[i];
    }
    sum += either > 0 ? double(both) / double(either) : 1.0;
  }
  return sum / kViews;
}

}  // namespace pleat::bench
