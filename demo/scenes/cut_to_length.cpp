#include "demo/scenes/cut_to_length.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace pleat::demo {
namespace {

using Eigen::Vector3d;

constexpr int kSteps = 12;              // in which an edge is measured
constexpr double kLongestDetour = 1.5;  // of what is straight: more, and the nearest point has jumped elsewhere
constexpr int kPasses = 200;            // of moving vertices until edges fit
constexpr double kNoExtent = 1e-9;      // m2, of a triangle

using Edge = std::pair<uint32_t, uint32_t>;  // the lower vertex first

Vector3d point(const TriangleMesh& mesh, uint32_t v) {
  return {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
}

/// How many triangles there are at each edge.
std::map<Edge, int> edges_of(const TriangleMesh& mesh) {
  std::map<Edge, int> edges;
  for (size_t t = 0; t < mesh.triangle_count(); ++t) {
    for (size_t k = 0; k < 3; ++k) ++edges[std::minmax(mesh.triangles[3 * t + k], mesh.triangles[3 * t + (k + 1) % 3])];
  }
  return edges;
}

/// Triangles, or segments whose third corner is their second, and what of them is nearest to a point.
class Shape {
 public:
  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    pieces_.push_back({a, b, c});
    boxes_.emplace_back(Eigen::AlignedBox3d(a).extend(b).extend(c));
  }
  bool empty() const { return pieces_.empty(); }

  Vector3d nearest(const Vector3d& p) const {
    Vector3d best = pieces_[0][0];
    double least = (p - best).squaredNorm();
    for (size_t k = 0; k < pieces_.size(); ++k) {
      if (boxes_[k].squaredExteriorDistance(p) >= least) continue;
      const Vector3d found = nearest(p, pieces_[k]);
      const double distance = (p - found).squaredNorm();
      if (distance < least) least = distance, best = found;
    }
    return best;
  }

 private:
  using Piece = std::array<Vector3d, 3>;

  static Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const Vector3d along = b - a;
    const double length2 = along.squaredNorm();
    return length2 > 0.0 ? Vector3d(a + std::clamp((p - a).dot(along) / length2, 0.0, 1.0) * along) : a;
  }
  static Vector3d nearest(const Vector3d& p, const Piece& x) {
    const Vector3d normal = (x[1] - x[0]).cross(x[2] - x[0]);
    if (normal.norm() > kNoExtent) {
      const auto beside = [&](size_t k) { return normal.cross(x[(k + 1) % 3] - x[k]).dot(p - x[k]) < 0.0; };
      if (!beside(0) && !beside(1) && !beside(2)) return p - normal * (normal.dot(p - x[0]) / normal.squaredNorm());
    }
    Vector3d best = nearest_on_segment(p, x[0], x[1]);
    for (size_t k = 1; k < 3; ++k) {
      const Vector3d other = nearest_on_segment(p, x[k], x[(k + 1) % 3]);
      if ((p - other).squaredNorm() < (p - best).squaredNorm()) best = other;
    }
    return best;
  }

  std::vector<Piece> pieces_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

/// The length of the way along the shape from a to b, both on it.
double length_along(const Shape& shape, const Vector3d& a, const Vector3d& b) {
  double sum = 0.0;
  Vector3d last = a;
  for (int k = 1; k <= kSteps; ++k) {
    const Vector3d next = k == kSteps ? b : shape.nearest(a + (b - a) * (double(k) / kSteps));
    sum += (next - last).norm();
    last = next;
  }
  const double straight = (b - a).norm();
  return sum <= kLongestDetour * straight ? sum : straight;
}

}  // namespace

void cut_to_length(const TriangleMesh& fine, TriangleMesh& coarse) {
  Shape surface, border;
  for (size_t t = 0; t < fine.triangle_count(); ++t) {
    const uint32_t* v = &fine.triangles[3 * t];
    surface.add(point(fine, v[0]), point(fine, v[1]), point(fine, v[2]));
  }
  for (const auto& [edge, sides] : edges_of(fine)) {
    if (sides == 1) border.add(point(fine, edge.first), point(fine, edge.second), point(fine, edge.second));
  }
  const std::map<Edge, int> edges = edges_of(coarse);
  std::vector<bool> on_border(coarse.vertex_count(), false);
  for (const auto& [edge, sides] : edges) {
    if (sides == 1) on_border[edge.first] = on_border[edge.second] = true;
  }
  std::vector<Vector3d> x(coarse.vertex_count());
  for (uint32_t v = 0; v < x.size(); ++v) {
    x[v] = (on_border[v] && !border.empty() ? border : surface).nearest(point(coarse, v));
  }
  std::vector<std::pair<Edge, double>> lengths;
  for (const auto& [edge, sides] : edges) {
    lengths.emplace_back(edge, length_along(surface, x[edge.first], x[edge.second]));
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const auto& [edge, length] : lengths) {
      const Vector3d way = x[edge.second] - x[edge.first];
      const double now = way.norm();
      if (!(now > 0.0)) continue;
      const Vector3d move = way * (0.5 * (length / now - 1.0));
      x[edge.first] -= move;
      x[edge.second] += move;
    }
  }
  for (uint32_t v = 0; v < x.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) coarse.positions[3 * v + uint32_t(axis)] = float(x[v][axis]);
  }
}

}  // namespace pleat::demo
