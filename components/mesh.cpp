#include "components/mesh.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace pleat {
namespace {

/// One side of a triangle: side k of triangle t runs from corner k to corner (k + 1) % 3.
struct Side {
  std::uint32_t low, high;  // its vertices
  std::uint32_t triangle, k;
  bool ascending;  // runs from low to high

  bool same_edge(const Side& b) const { return low == b.low && high == b.high; }
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Calls visit(first, last) for each run of sides that are the same edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit visit) {
  for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
    end = begin + 1;
    while (end < sides.size() && sides[end].same_edge(sides[begin])) ++end;
    visit(sides.data() + begin, sides.data() + end);
  }
}

/// Disjoint sets in which each element may be turned against its set's root; joining finds contradictions.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n), turned_(n, 0) { std::iota(parent_.begin(), parent_.end(), 0u); }

  struct Place {
    std::uint32_t root;
    bool turned;  // against the root
  };
  Place find(std::uint32_t i) {
    bool odd = false;
    while (parent_[i] != i) {  // path halving: i skips its parent and takes over the parent's turn
      const std::uint32_t up = parent_[i];
      turned_[i] ^= turned_[up];
      parent_[i] = parent_[up];
      odd ^= turned_[i] != 0;
      i = parent_[i];
    }
    return {i, odd};
  }
  std::uint32_t root(std::uint32_t i) { return find(i).root; }
  bool turned(std::uint32_t i) { return find(i).turned; }

  /// Joins a's and b's sets; false where they already are one and `turned_to_each_other` contradicts what is known.
  bool join(std::uint32_t a, std::uint32_t b, bool turned_to_each_other = false) {
    const Place pa = find(a), pb = find(b);
    const bool odd = pa.turned ^ pb.turned ^ turned_to_each_other;
    if (pa.root == pb.root) return !odd;
    const std::uint32_t below = std::max(pa.root, pb.root);
    parent_[below] = std::min(pa.root, pb.root);
    turned_[below] = odd ? 1 : 0;
    return true;
  }
  std::uint32_t count() const {
    std::uint32_t n = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) n += parent_[i] == i ? 1u : 0u;
    return n;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> turned_;
};

bool is_degenerate(std::span<const Vec3> p, const Triangle& t) {
  const Vec3 u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]], w = p[t[2]] - p[t[1]];
  const float longest = std::max({dot(u, u), dot(v, v), dot(w, w)});
  // A sliver of aspect 10^6 has no normal in single precision.
  return !(length(cross(u, v)) > 1e-6f * longest);
}

void drop_bad_triangles(std::span<const Vec3> positions, std::vector<Triangle>& triangles, MeshReport& report) {
  std::set<Triangle> seen;
  std::erase_if(triangles, [&](const Triangle& t) {
    if (is_degenerate(positions, t)) return ++report.degenerate_triangles, true;
    Triangle sorted = t;
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).second) return ++report.duplicate_triangles, true;
    return false;
  });
}

std::string edge_name(const Side& side) { return "edge " + std::to_string(side.low) + "-" + std::to_string(side.high); }

/// Turns the minority of each part so that every inner edge is run through once each way.
void orient(std::vector<Triangle>& triangles, MeshReport& report) {
  Sets parts(triangles.size());
  for_each_edge(sorted_sides(triangles), [&](const Side* first, const Side* last) {
    if (last - first > 2) {
      if (report.nonmanifold_edges++ == 0 && report.fault.empty()) {
        report.fault =
            edge_name(*first) + " has " + std::to_string(last - first) + " triangles, at most 2 can be cloth";
      }
    } else if (last - first == 2 &&
               !parts.join(first[0].triangle, first[1].triangle, first[0].ascending == first[1].ascending)) {
      if (report.nonorientable_edges++ == 0 && report.fault.empty()) {
        report.fault = "no consistent winding exists across " + edge_name(*first) + " (a one-sided surface)";
      }
    }
  });
  report.parts = parts.count();
  if (!report.fault.empty()) return;

  std::vector<std::int64_t> balance(triangles.size(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) balance[parts.root(t)] += parts.turned(t) ? -1 : 1;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const bool minority = parts.turned(t) == (balance[parts.root(t)] >= 0);
    if (minority) {
      std::swap(triangles[t][1], triangles[t][2]);
      ++report.flipped_triangles;
    }
  }
}

/// Counts fans around vertices and loops of the border.
void survey(std::size_t vertex_count, const std::vector<Triangle>& triangles, MeshReport& report) {
  Sets fans(3 * triangles.size());  // an element per triangle corner
  Sets border(vertex_count);
  std::vector<std::uint8_t> on_border(vertex_count, 0);
  const auto corner = [&](const Side& side, std::uint32_t vertex) {
    const bool at_start = (side.ascending ? side.low : side.high) == vertex;
    return 3 * side.triangle + (at_start ? side.k : (side.k + 1) % 3);
  };
  for_each_edge(sorted_sides(triangles), [&](const Side* first, const Side* last) {
    if (last - first == 2) {
      for (const std::uint32_t v : {first->low, first->high}) fans.join(corner(first[0], v), corner(first[1], v));
    } else {
      border.join(first->low, first->high);
      on_border[first->low] = on_border[first->high] = 1;
    }
  });

  std::vector<std::uint32_t> fan_count(vertex_count, 0);
  std::vector<std::uint8_t> used(vertex_count, 0);
  for (std::uint32_t c = 0; c < 3 * triangles.size(); ++c) {
    const std::uint32_t vertex = triangles[c / 3][c % 3];
    used[vertex] = 1;
    if (fans.root(c) == c) ++fan_count[vertex];
  }
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    report.unreferenced_vertices += used[v] ? 0u : 1u;
    report.nonmanifold_vertices += fan_count[v] > 1 ? 1u : 0u;
    report.border_loops += on_border[v] && border.root(v) == v ? 1u : 0u;
  }
}

}  // namespace

MeshReport check_and_repair(std::span<const Vec3> positions, std::vector<Triangle>& triangles) {
  MeshReport report;
  drop_bad_triangles(positions, triangles, report);
  if (triangles.empty()) {
    report.fault = "no triangle with an area is left";
    return report;
  }
  orient(triangles, report);
  if (report.fault.empty()) survey(positions.size(), triangles, report);
  return report;
}

}  // namespace pleat
