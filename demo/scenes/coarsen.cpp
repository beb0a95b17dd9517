#include "demo/scenes/coarsen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

namespace pleat::demo {
namespace {

using Eigen::Vector3d;

constexpr double kLeastCosine = 0.5;  // between a triangle's normals before and after

using Corners = std::array<uint32_t, 3>;
using Edge = std::pair<uint32_t, uint32_t>;  // the lower vertex first

class Coarsener {
 public:
  explicit Coarsener(const TriangleMesh& mesh) : around_(mesh.vertex_count()) {
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
      points_.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
    }
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
      triangles_.push_back({mesh.triangles[3 * t], mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]});
      for (const uint32_t v : triangles_.back()) around_[v].insert(uint32_t(t));
    }
    for (const Corners& t : triangles_) {
      for (size_t k = 0; k < 3; ++k) file(std::minmax(t[k], t[(k + 1) % 3]));
    }
    left_ = size_t(std::ranges::count_if(around_, [](const auto& triangles) { return !triangles.empty(); }));
  }

  void run(size_t vertices) {
    while (left_ > vertices) {
      const auto found = std::ranges::find_if(queue_, [this](const auto& entry) { return may_collapse(entry.second); });
      if (found == queue_.end()) return;
      collapse(found->second);
    }
  }

  TriangleMesh result() const {
    TriangleMesh mesh;
    std::vector<uint32_t> place(points_.size());
    for (size_t v = 0; v < points_.size(); ++v) {
      if (around_[v].empty()) continue;
      place[v] = uint32_t(mesh.vertex_count());
      for (int axis = 0; axis < 3; ++axis) mesh.positions.push_back(float(points_[v][axis]));
    }
    for (const Corners& t : triangles_) {
      if (t[0] == t[1]) continue;
      for (const uint32_t v : t) mesh.triangles.push_back(place[v]);
    }
    return mesh;
  }

 private:
  void file(const Edge& edge) {
    const double length = (points_[edge.first] - points_[edge.second]).norm();
    if (lengths_.emplace(edge, length).second) queue_.emplace(length, edge);
  }
  void drop(const Edge& edge) {
    const auto found = lengths_.find(edge);
    if (found == lengths_.end()) return;
    queue_.erase({found->second, edge});
    lengths_.erase(found);
  }

  std::set<uint32_t> neighbours(uint32_t v) const {
    std::set<uint32_t> ring;
    for (const uint32_t t : around_[v]) ring.insert(triangles_[t].begin(), triangles_[t].end());
    ring.erase(v);
    return ring;
  }
  size_t triangles_at(const Edge& edge) const {
    return size_t(
        std::ranges::count_if(around_[edge.first], [&](uint32_t t) { return around_[edge.second].contains(t); }));
  }
  bool on_border(uint32_t v) const {
    return std::ranges::any_of(neighbours(v), [&](uint32_t w) { return triangles_at(std::minmax(v, w)) == 1; });
  }
  Vector3d target(const Edge& edge) const {
    const bool first = on_border(edge.first), second = on_border(edge.second);
    if (first != second) return points_[first ? edge.first : edge.second];
    return 0.5 * (points_[edge.first] + points_[edge.second]);
  }

  bool may_collapse(const Edge& edge) const {
    const auto [a, b] = edge;
    const size_t sides = triangles_at(edge);
    std::vector<uint32_t> common;
    std::ranges::set_intersection(neighbours(a), neighbours(b), std::back_inserter(common));
    if (common.size() != sides || sides > 2) return false;
    if (around_[a].size() == sides && around_[b].size() == sides) return false;  // neither would keep a triangle
    if (sides == 2 && on_border(a) && on_border(b)) return false;                // it would pinch the surface together
    if (sides == 2 && neighbours(a).size() == 3 && neighbours(b).size() == 3) return false;  // a tetrahedron
    const Vector3d to = target(edge);
    for (const uint32_t v : {a, b}) {
      for (const uint32_t t : around_[v]) {
        if (around_[v == a ? b : a].contains(t)) continue;
        if (normal(t, v, to).dot(normal(t, v, points_[v])) < kLeastCosine) return false;
      }
    }
    return true;
  }

  /// With corner v at p.
  Vector3d normal(uint32_t t, uint32_t v, const Vector3d& p) const {
    std::array<Vector3d, 3> x;
    for (size_t k = 0; k < 3; ++k) x[k] = triangles_[t][k] == v ? p : points_[triangles_[t][k]];
    return (x[1] - x[0]).cross(x[2] - x[0]).normalized();
  }

  /// The second end becomes one with the first.
  void collapse(const Edge edge) {
    const auto [a, b] = edge;
    const Vector3d to = target(edge);
    for (const uint32_t v : {a, b}) {
      for (const uint32_t w : neighbours(v)) drop(std::minmax(v, w));
    }
    for (const uint32_t t : std::set<uint32_t>(around_[b])) {
      Corners& corners = triangles_[t];
      if (around_[a].contains(t)) {
        for (const uint32_t v : corners) around_[v].erase(t);
        corners = {};
      } else {
        std::ranges::replace(corners, b, a);
        around_[a].insert(t);
      }
    }
    around_[b].clear();
    points_[a] = to;
    for (const uint32_t w : neighbours(a)) file(std::minmax(a, w));
    --left_;
  }

  std::vector<Vector3d> points_;
  std::vector<Corners> triangles_;           // all zero where one has gone
  std::vector<std::set<uint32_t>> around_;   // triangles at a vertex
  std::set<std::pair<double, Edge>> queue_;  // shortest first
  std::map<Edge, double> lengths_;           // of the edges in the queue
  size_t left_ = 0;
};

}  // namespace

TriangleMesh coarsen(const TriangleMesh& mesh, size_t vertices) {
  Coarsener coarsener(mesh);
  coarsener.run(vertices);
  return coarsener.result();
}

}  // namespace pleat::demo
