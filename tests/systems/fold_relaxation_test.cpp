#include "systems/fold_relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "components/pn_edge.h"
#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

struct Relaxed : Surface {
  FoldScratch scratch{std::pmr::get_default_resource()};

  explicit Relaxed(const Mesh& mesh, std::uint32_t level = 0) : Surface(mesh, level) {
    scratch.middle.resize(garment.edge_count), scratch.pull.resize(garment.edge_count);
    scratch.half_length.resize(garment.edge_count), scratch.freedom.resize(garment.edge_count);
  }
  FoldRelaxation system(std::uint32_t sweeps) {
    return {sweeps, &garment, position.view(), normal.view(), fold.view(), fold_height.data(), scratch.view()};
  }
  void fold_edges() {
    particle_normals().run();
    fold_sides().run();
    edge_length().run();
  }
  void relax(std::uint32_t sweeps) {
    fold_edges();
    system(sweeps).run();
    tessellation().run();
  }
  Vec3 middle(std::uint32_t e) {
    const std::uint32_t i = garment.edge_particle[0][e], j = garment.edge_particle[1][e];
    const PnEdge c(position.view()[i], position.view()[j], normal.view()[i], normal.view()[j]);
    return c.middle() + fold.view()[e] * fold_height[e];
  }
  /// E: how much the segments between middles miss half of the side along them, and the halves of edges `half`.
  double energy(const std::vector<float>& half) {
    double sum = 0.0;
    const auto add = [&](float l, float wanted) { sum += 0.5 * double(l - wanted) * double(l - wanted); };
    for (std::uint32_t f = 0; f < garment.face_count; ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        add(length(middle(garment.face_edge[k][f]) - middle(garment.face_edge[(k + 1) % 3][f])),
            0.5f * garment.edge_rest_curve_length[garment.face_edge[(k + 2) % 3][f]]);
      }
    }
    for (std::uint32_t e = 0; e < garment.edge_count; ++e) {
      for (std::uint32_t k = 0; k < 2; ++k) {
        add(length(middle(e) - position.view()[garment.edge_particle[k][e]]), half[e]);
      }
    }
    return sum;
  }
  std::vector<float> halves() {
    std::vector<float> half;
    for (std::uint32_t e = 0; e < garment.edge_count; ++e) {
      half.push_back(0.5f * (length(middle(e) - position.view()[garment.edge_particle[0][e]]) +
                             length(middle(e) - position.view()[garment.edge_particle[1][e]])));
    }
    return half;
  }
};

/// A sheet pressed together along x over a gentle arch, so that its folds have a side to go to.
Vec3 arched(const Vec3& x) { return {0.9f * x.x, 0.1f * std::cos(2.0f * x.x) + 0.05f * x.x * x.z, x.z}; }

TEST(FoldRelaxation, BringsTheSegmentsInFacesCloserToTheirLength) {
  Relaxed s(sheet(9));
  s.move(arched);
  s.jitter(0.004f, 3);
  s.fold_edges();
  const std::vector<float> half = s.halves();
  const double before = s.energy(half);
  double last = before;
  for (const std::uint32_t sweeps : {2u, 8u, 32u}) {
    s.fold_edges();
    s.system(sweeps).run();
    EXPECT_LT(s.energy(half), last) << sweeps;
    last = s.energy(half);
  }
  EXPECT_LT(last, 0.7 * before);
}

TEST(FoldRelaxation, ChangesNoBitWhereNothingIsCompressed) {
  for (const float scale : {1.0f, 1.05f}) {
    Relaxed s(skirt(), 3);
    s.move([&](const Vec3& x) { return x * scale; });
    s.run();
    std::vector<Vec3> off;
    for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) off.push_back(s.drawn.view()[v]);
    s.relax(16);
    for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) EXPECT_EQ(s.drawn.view()[v], off[v]);
  }
}

TEST(FoldRelaxation, LeavesUnfoldedEdgesAloneBitForBit) {
  Relaxed s(sheet(9));
  s.move([](const Vec3& x) { return x.x < 0.1f ? x : Vec3{0.1f + 0.85f * (x.x - 0.1f), 0.2f * x.x * x.x, x.z}; });
  s.fold_edges();
  std::vector<float> height(s.fold_height.begin(), s.fold_height.end());
  std::vector<Vec3> fold;
  for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) fold.push_back(s.fold.view()[e]);
  s.system(16).run();
  int unfolded = 0, moved = 0;
  for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
    if (height[e] == 0.0f) {
      EXPECT_EQ(s.fold_height[e], 0.0f);
      EXPECT_EQ(s.fold.view()[e], fold[e]);
      ++unfolded;
    } else {
      moved += s.fold_height[e] != height[e];
    }
  }
  EXPECT_GT(unfolded, 20);
  EXPECT_GT(moved, 20);
}

TEST(FoldRelaxation, TurnsWithTheClothProperty) {
  const float c = 0.6f, sn = 0.8f;
  const auto turned = [&](const Vec3& x) { return Vec3{c * x.x - sn * x.y, sn * x.x + c * x.y, x.z} + Vec3{1, -2, 3}; };
  Relaxed here(sheet(7), 2), there(sheet(7), 2);
  here.move(arched), here.jitter(0.004f, 5);
  there.move(arched), there.jitter(0.004f, 5), there.move(turned);
  here.relax(16), there.relax(16);
  for (std::uint32_t v = 0; v < here.pattern.vertex_count; ++v) {
    EXPECT_LT(length(there.drawn.view()[v] - turned(here.drawn.view()[v])), 2e-4f);
  }
}

TEST(FoldRelaxation, SmallMovesMoveTheSurfaceLittleProperty) {
  constexpr float kMove = 1e-5f;  // m
  for (unsigned seed = 0; seed < 20; ++seed) {
    Relaxed s(sheet(6)), t(sheet(6));
    // From flat and unfolded to deeply folded, so that folds begin on the way.
    const float pressed = 1.0f - 0.01f * static_cast<float>(seed);
    const auto press = [&](const Vec3& x) { return Vec3{pressed * x.x, 0.05f * x.x * x.x, x.z}; };
    s.move(press), s.jitter(0.003f, seed), t.move(press), t.jitter(0.003f, seed);
    s.relax(16), t.relax(16);
    t.jitter(kMove, seed + 100);
    t.follow(s, 1e-5f);  // s: too short for a fold to go to its other side
    t.relax(16);
    for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) {
      EXPECT_LT(length(s.drawn.view()[v] - t.drawn.view()[v]), 200.0f * kMove);
    }
  }
}

TEST(FoldRelaxation, StaysFiniteAndBoundedForAnyCloth) {
  const auto check = [](Relaxed& s, const char* what) {
    s.relax(64);
    for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) {
      EXPECT_TRUE(is_finite(s.drawn.view()[v])) << what;
      EXPECT_LT(length(s.drawn.view()[v]), 4.0f) << what;
    }
  };
  Relaxed point(sheet(5)), line(sheet(5)), folded(sheet(5)), noise(sheet(5));
  point.move([](const Vec3&) { return Vec3{}; });
  line.move([](const Vec3& x) { return Vec3{x.x, 0, 0}; });
  folded.move([](const Vec3& x) { return Vec3{std::abs(x.x), 0, x.z}; });
  noise.jitter(1.0f, 9);
  check(point, "point"), check(line, "line"), check(folded, "folded"), check(noise, "noise");
}

TEST(FoldRelaxation, Validates) {
  Relaxed s(sheet(3));
  EXPECT_TRUE(s.system(1).validate());
  EXPECT_FALSE(s.system(0).validate());
  FoldRelaxation r = s.system(1);
  r.garment = nullptr;
  EXPECT_FALSE(r.validate());
  r = s.system(1), r.position = {};
  EXPECT_FALSE(r.validate());
  r = s.system(1), r.normal = {};
  EXPECT_FALSE(r.validate());
  r = s.system(1), r.fold = {};
  EXPECT_FALSE(r.validate());
  r = s.system(1), r.fold_height = nullptr;
  EXPECT_FALSE(r.validate());
  r = s.system(1), r.scratch = {};
  EXPECT_FALSE(r.validate());
}

}  // namespace
}  // namespace pleat
