#include "systems/rigid_fit.h"

#include <algorithm>
#include <array>

namespace pleat {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// m m over its trace: symmetric, and its largest eigenvalue stands out more than that of m.
Matrix4 squared(const Matrix4& m) {
  Matrix4 s{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) s[i][j] += m[i][k] * m[k][j];
    }
  }
  const double trace = s[0][0] + s[1][1] + s[2][2] + s[3][3];
  for (auto& row : s) {
    for (double& x : row) x /= trace;
  }
  return s;
}

}  // namespace

void PointPairs::add(const Vec3& a, const Vec3& b) {
  const double from[3] = {double(a.x), double(a.y), double(a.z)}, to[3] = {double(b.x), double(b.y), double(b.z)};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) products[i][j] += from[i] * to[j];
  }
  spread += 0.5 * (double(dot(a, a)) + double(dot(b, b)));
}

Quaternion best_rotation(const PointPairs& pairs) {
  const auto& [sx, sy, sz] = pairs.products;
  // Horn's matrix, in the order w, x, y, z. Shifted so that no eigenvalue is negative; what favours w and then y is
  // too small to turn a rotation that the points decide.
  const double shift = pairs.spread + 1e-30, favour = 1e-5 * shift;
  Matrix4 m = {{{sx[0] + sy[1] + sz[2] + favour, sy[2] - sz[1], sz[0] - sx[2], sx[1] - sy[0]},
                {0.0, sx[0] - sy[1] - sz[2], sx[1] + sy[0], sz[0] + sx[2]},
                {0.0, 0.0, sy[1] - sx[0] - sz[2] + 0.1 * favour, sy[2] + sz[1]},
                {0.0, 0.0, 0.0, sz[2] - sx[0] - sy[1]}}};
  for (std::size_t i = 0; i < 4; ++i) {
    m[i][i] += shift;
    for (std::size_t j = 0; j < i; ++j) m[i][j] = m[j][i];
  }
  constexpr int kSquarings = 32;  // the 2^32th power tells eigenvalues apart that differ by `favour`
  for (int i = 0; i < kSquarings; ++i) m = squared(m);
  // Now q q^T of the eigenvector q; its longest column is the most exact.
  std::size_t k = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (m[i][i] > m[k][k]) k = i;
  }
  const double scale = (m[0][k] < 0.0 ? -1.0 : 1.0) / std::sqrt(m[k][k]);
  return {static_cast<float>(m[1][k] * scale), static_cast<float>(m[2][k] * scale), static_cast<float>(m[3][k] * scale),
          static_cast<float>(m[0][k] * scale)};
}

Vec3 mean_of(const ConstVec3View& points, std::size_t count) {
  double x = 0.0, y = 0.0, z = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    x += double(points.x[i]), y += double(points.y[i]), z += double(points.z[i]);
  }
  const double scale = 1.0 / static_cast<double>(count);
  return {static_cast<float>(x * scale), static_cast<float>(y * scale), static_cast<float>(z * scale)};
}

RigidMotion best_motion(const ConstVec3View& from, const ConstVec3View& to, std::size_t count) {
  const Vec3 begin = mean_of(from, count), end = mean_of(to, count);
  PointPairs pairs;
  for (std::size_t k = 0; k < count; ++k) pairs.add(from[k] - begin, to[k] - end);
  return {begin, end, best_rotation(pairs)};
}

}  // namespace pleat
