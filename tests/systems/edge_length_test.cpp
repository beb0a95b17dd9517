#include "systems/edge_length.h"

#include <gtest/gtest.h>

#include <numbers>

#include "components/pn_edge.h"
#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

using Point = Vec3T<double>;

Point wide(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Length of x(t), t in 0..1, by 100 chords and by 50, extrapolated: an oracle that shares no formula with the code.
template <class Curve>
double polyline_length(const Curve& x) {
  Point point[101];
  for (int i = 0; i <= 100; ++i) point[i] = x(0.01 * i);
  double fine = 0.0, coarse = 0.0;
  for (int i = 0; i < 100; i += 2) {
    fine += length(point[i + 1] - point[i]) + length(point[i + 2] - point[i + 1]);
    coarse += length(point[i + 2] - point[i]);
  }
  return (4.0 * fine - coarse) / 3.0;
}

/// A cubic by de Casteljau.
struct Cubic {
  Point p[4];

  static Point mix(const Point& a, const Point& b, double t) { return a * (1.0 - t) + b * t; }
  Point at(double t) const {
    const Point a = mix(p[0], p[1], t), b = mix(p[1], p[2], t), c = mix(p[2], p[3], t);
    return mix(mix(a, b, t), mix(b, c, t), t);
  }
  double length() const {
    return polyline_length([this](double t) { return at(t); });
  }
  /// Of its halves with the joint and the joint's neighbours moved.
  double folded_length(const Point& move) const {
    const Point a = mix(p[0], p[1], 0.5), b = mix(p[1], p[2], 0.5), c = mix(p[2], p[3], 0.5);
    const Point ab = mix(a, b, 0.5) + move, bc = mix(b, c, 0.5) + move, middle = at(0.5) + move;
    return Cubic{{p[0], a, ab, middle}}.length() + Cubic{{middle, bc, c, p[3]}}.length();
  }
};

Cubic pn_cubic(const Point& a, const Point& b, const Point& na, const Point& nb) {
  const double third = 1.0 / 3.0;
  return {{a, (2.0 * a + b - na * dot(b - a, na)) * third, (2.0 * b + a - nb * dot(a - b, nb)) * third, b}};
}

/// Many loose edges, each of its own shape, run through the system at once: only the edge columns are used.
struct Edges {
  Garment garment{std::pmr::get_default_resource()};
  Vec3Column position, normal, fold;
  Column<float> height, sides;
  SurfaceMode mode;

  explicit Edges(SurfaceMode m, std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : position(memory), normal(memory), fold(memory), height(memory), sides(memory), mode(m) {}

  void add(const Vec3& a, const Vec3& b, const Vec3& na, const Vec3& nb, float rest_length, float side = 1.0f) {
    const std::uint32_t e = garment.edge_count++, i = 2 * e, j = i + 1;
    garment.particle_count = j + 1;
    garment.edge_particle[0].push_back(i), garment.edge_particle[1].push_back(j);
    garment.edge_normal[0].push_back(i), garment.edge_normal[1].push_back(j);
    garment.edge_rest_length.push_back(rest_length), garment.edge_rest_curve_length.push_back(rest_length);
    position.resize(j + 1), normal.resize(j + 1), fold.resize(e + 1), height.resize(e + 1);
    position.view().set(i, a), position.view().set(j, b);
    normal.view().set(i, na), normal.view().set(j, nb);
    sides.push_back(side);
  }
  EdgeLength system() {
    return {mode, &garment, position.view(), normal.view(), fold.view(), height.data(), sides.data()};
  }
  Cubic cubic(std::uint32_t e) const {
    return pn_cubic(wide(position.view()[2 * e]), wide(position.view()[2 * e + 1]), wide(normal.view()[2 * e]),
                    wide(normal.view()[2 * e + 1]));
  }
  Point direction(std::uint32_t e) const { return wide(fold.view()[e]); }
  /// Length of the drawn edge.
  double drawn_length(std::uint32_t e) const {
    const double h = height[e];
    if (mode == SurfaceMode::kPleat) return cubic(e).folded_length(direction(e) * h);
    const Cubic c = cubic(e);
    const Point n = direction(e), p = c.at(0.5) + n * h;
    return pn_cubic(c.p[0], p, wide(normal.view()[2 * e]), n).length() +
           pn_cubic(p, c.p[3], n, wide(normal.view()[2 * e + 1])).length();
  }
};

/// Edges compressed to 0.3..1 of their rest length, normals tilted by up to 60 degrees any way.
Edges random_edges(SurfaceMode mode, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  Edges edges(mode);
  for (int i = 0; i < count; ++i) {
    const auto normal = [&] {
      const float tilt = unit(random) * std::numbers::pi_v<float> / 3.0f, turn = unit(random) * 6.2831853f;
      return Vec3{std::sin(tilt) * std::cos(turn), std::cos(tilt), std::sin(tilt) * std::sin(turn)};
    };
    const float rest = 0.05f + 0.2f * unit(random), d = rest * (0.3f + 0.7f * unit(random));
    const Vec3 a{unit(random), unit(random), unit(random)};
    edges.add(a, a + Vec3{d, 0, 0}, normal(), normal(), rest, i % 2 == 0 ? 1.0f : -1.0f);
  }
  return edges;
}

TEST(EdgeLength, PaperKeepsTheRestLengthToATenthOfAPercent) {
  Edges edges = random_edges(SurfaceMode::kPaper, 2000, 1);
  edges.system().run();
  int folded = 0;
  for (std::uint32_t e = 0; e < edges.garment.edge_count; ++e) {
    const double rest = edges.garment.edge_rest_length[e];
    EXPECT_GE(edges.height[e], 0.0f);
    if (edges.height[e] > 0.0f) {
      EXPECT_NEAR(edges.drawn_length(e) / rest, 1.0, 1e-3);
      ++folded;
    } else {
      EXPECT_GE(edges.drawn_length(e), rest * (1.0 - 1e-3));
    }
  }
  EXPECT_GT(folded, 1500);
}

TEST(EdgeLength, PleatMeetsItsTarget) {
  Edges edges = random_edges(SurfaceMode::kPleat, 120000, 2);
  edges.system().run();
  double worst = 0.0, sum = 0.0;
  int sure = 0;
  for (std::uint32_t e = 0; e < edges.garment.edge_count; ++e) {
    const double rest = edges.garment.edge_rest_length[e];
    const Cubic c = edges.cubic(e);
    const double l0 = c.length(), deficit = rest - l0;
    if (deficit <= 1e-6) {
      EXPECT_NEAR(edges.height[e], 0.0f, 1e-3f * static_cast<float>(rest));
      continue;
    }
    const double target = l0 + deficit * deficit / (deficit + 0.0045 * rest);
    const Point n = edges.direction(e);
    const double step = 1e-4 * rest, slope = (c.folded_length(n * step) - c.folded_length(n * -step)) / (2.0 * step);
    EXPECT_GE(edges.sides[e] * edges.height[e], 0.0f);
    if (slope * static_cast<double>(edges.sides[e]) < 0.0) {  // against the bulge: may stop short
      EXPECT_LE(edges.drawn_length(e), target * 1.02);
      continue;
    }
    EXPECT_LE(edges.drawn_length(e), target * 1.005);
    const double error = std::abs(edges.drawn_length(e) / target - 1.0);
    worst = std::max(worst, error), sum += error;
    ++sure;
  }
  EXPECT_LT(worst, 5e-3);
  EXPECT_LT(sum / sure, 1e-3);
  EXPECT_GT(sure, 50000);
}

TEST(EdgeLength, NoFoldAtRest) {
  for (const std::uint32_t shape : {0u, 1u}) {
    Surface s(shape == 0 ? skirt() : sheet(7));
    s.run();
    for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) EXPECT_EQ(s.fold_height[e], 0.0f);
  }
}

TEST(EdgeLength, NoFoldWhereElongated) {
  Surface s(skirt());
  s.move([](const Vec3& x) { return x * 1.05f; });
  for (const SurfaceMode mode : {SurfaceMode::kPaper, SurfaceMode::kPleat}) {
    s.mode = mode;
    s.run();
    for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) EXPECT_EQ(s.fold_height[e], 0.0f);
  }
}

TEST(EdgeLength, PleatFoldsToTheSideThatWasChosen) {
  for (const float tilt : {0.1f, -0.1f}) {
    for (const float side : {1.0f, 0.4f, 0.0f, -1.0f}) {
      Edges edges(SurfaceMode::kPleat);
      const Vec3 na{-std::sin(tilt), std::cos(tilt), 0}, nb{std::sin(tilt), std::cos(tilt), 0};
      edges.add({0, 0, 0}, {0.08f, 0, 0}, na, nb, 0.1f, side);
      edges.system().run();
      EXPECT_EQ(edges.height[0] > 0.0f, side > 0.0f);
      EXPECT_EQ(edges.height[0] < 0.0f, side < 0.0f);
      EXPECT_LT(length(edges.fold.view()[0] - Vec3{0, 1, 0}), 1e-5f);
    }
  }
}

TEST(EdgeLength, PleatHeightIsSmoothInCompressionBulgeAndSide) {
  const auto height = [](float chord, float tilt, float side) {
    Edges edges(SurfaceMode::kPleat);
    edges.add({0, 0, 0}, {chord, 0, 0}, {-std::sin(tilt), std::cos(tilt), 0}, {std::sin(tilt), std::cos(tilt), 0}, 1.0f,
              side);
    edges.system().run();
    return edges.height[0];
  };
  for (const float side : {1.0f, -1.0f}) {  // through the rest length, with the bulge and against it
    float last = height(1.05f, 0.2f, side);
    EXPECT_EQ(last, 0.0f);
    for (float chord = 1.05f; chord > 0.5f; chord -= 1e-3f) {
      const float h = height(chord, 0.2f, side);
      EXPECT_LT(std::abs(h - last), 0.016f) << chord << " " << side;
      last = h;
    }
    EXPECT_GT(last * side, 0.1f);
  }
  float last = height(0.9f, -0.3f, 1.0f);
  EXPECT_GT(last, 0.1f);
  for (float tilt = -0.3f; tilt < 0.3f; tilt += 1e-3f) {
    const float h = height(0.9f, tilt, 1.0f);
    EXPECT_LT(std::abs(h - last), 8e-3f) << tilt;
    last = h;
  }
  EXPECT_GT(last, 0.1f);
  last = height(0.9f, 0.2f, 1.0f);
  for (float side = 1.0f; side > -1.0f; side -= 1e-3f) {
    const float h = height(0.9f, 0.2f, side);
    EXPECT_LT(std::abs(h - last), 8e-3f) << side;
    last = h;
  }
  EXPECT_LT(last, -0.1f);
}

TEST(EdgeLength, DoesNotDependOnNeighboursInTheBlock) {
  Edges edges = random_edges(SurfaceMode::kPleat, 37, 3);
  edges.system().run();
  for (std::uint32_t e = 0; e < 37; ++e) {
    Edges one(SurfaceMode::kPleat);
    one.add(edges.position.view()[2 * e], edges.position.view()[2 * e + 1], edges.normal.view()[2 * e],
            edges.normal.view()[2 * e + 1], edges.garment.edge_rest_length[e], edges.sides[e]);
    one.system().run();
    EXPECT_EQ(one.height[0], edges.height[e]);
    EXPECT_EQ(one.fold.view()[0], edges.fold.view()[e]);
  }
}

TEST(EdgeLength, CurvesThatFoldSidesLeftGiveTheSameBits) {
  for (const float crease_angle : {4.0f, 0.5f}) {
    Surface s(garment_of(skirt(), crease_angle), 0);
    s.move([](const Vec3& x) { return Vec3{0.85f * x.x, x.y, x.z}; });
    s.jitter(0.01f, 5);
    s.run();
    const std::vector<float> height(s.fold_height.begin(), s.fold_height.end());
    Vec3Column fold(std::pmr::get_default_resource());
    fold.resize(s.garment.edge_count);
    copy(fold.view(), s.fold.view(), s.garment.edge_count);

    std::ranges::fill(s.fold_height, -1.0f);
    clear(s.fold.view(), s.garment.edge_count);
    EdgeLength shared = s.edge_length();
    shared.curves = s.choices.curves.data();
    shared.run();
    int folded = 0;
    for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
      EXPECT_EQ(s.fold_height[e], height[e]) << e;
      EXPECT_EQ(s.fold.view()[e], fold.view()[e]) << e;
      folded += height[e] != 0.0f ? 1 : 0;
    }
    EXPECT_GT(folded, 50);
  }
}

TEST(EdgeLength, DegenerateEdgesStayFinite) {
  for (const SurfaceMode mode : {SurfaceMode::kPaper, SurfaceMode::kPleat}) {
    Edges edges(mode);
    const Vec3 up{0, 1, 0}, right{1, 0, 0}, a{0.3f, 1.0f, -2.0f};
    edges.add(a, a, up, up, 0.1f);                             // no chord
    edges.add(a, a, up, -up, 0.1f);                            // and opposite normals
    edges.add(a, a + Vec3{0.05f, 0, 0}, up, -up, 0.1f);        // opposite normals
    edges.add(a, a + Vec3{0.05f, 0, 0}, right, -right, 0.1f);  // along the chord
    edges.add(a, a + Vec3{0.05f, 0, 0}, right, right, 0.1f);   // S-shape with collapsed ends
    edges.add(a, a + Vec3{0.05f, 0, 0}, up, up, 0.1f, 0.0f);   // straight: no side to fold to
    edges.add(a, a + Vec3{1e-12f, 0, 0}, up, right, 0.1f);
    edges.add(a, a + Vec3{0.05f, 0, 0}, up, up, 0.0f);  // no rest length
    edges.system().run();
    for (std::uint32_t e = 0; e < edges.garment.edge_count; ++e) {
      EXPECT_TRUE(is_finite(edges.fold.view()[e])) << e;
      EXPECT_TRUE(std::isfinite(edges.height[e])) << e;
      EXPECT_LE(std::abs(edges.height[e]), 0.2f) << e;
    }
  }
}

TEST(EdgeLength, ValidateRefusesWhatIsMissing) {
  Surface s(skirt());
  EXPECT_TRUE(s.edge_length().validate());
  EdgeLength e = s.edge_length();
  e.garment = nullptr;
  EXPECT_FALSE(e.validate());
  e = s.edge_length(), e.position = {};
  EXPECT_FALSE(e.validate());
  e = s.edge_length(), e.normal = {};
  EXPECT_FALSE(e.validate());
  e = s.edge_length(), e.fold = {};
  EXPECT_FALSE(e.validate());
  e = s.edge_length(), e.fold_height = nullptr;
  EXPECT_FALSE(e.validate());
  e = s.edge_length(), e.side = nullptr;
  EXPECT_FALSE(e.validate());
  e.mode = SurfaceMode::kPaper;  // always folds outwards
  EXPECT_TRUE(e.validate());
  e = s.edge_length(), e.mode = SurfaceMode::kPn;
  EXPECT_FALSE(e.validate());
}

}  // namespace
}  // namespace pleat
