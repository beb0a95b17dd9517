// What holds for the drawn surface as a whole, in every mode and at every level.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/components/cube.h"
#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

constexpr SurfaceMode kModes[] = {SurfaceMode::kFlat,  SurfaceMode::kPn,    SurfaceMode::kPaper,
                                  SurfaceMode::kPleat, SurfaceMode::kPhong, SurfaceMode::kSpherigon,
                                  SurfaceMode::kArcPn};

/// The skirt pressed together and crumpled: about half of its edges are short.
Vec3 pressed(const Vec3& x) { return {0.85f * x.x, x.y, x.z}; }

using SurfaceProperty = testing::TestWithParam<std::uint32_t>;  // the level

TEST_P(SurfaceProperty, MovesWithTheClothHoweverItsVerticesAreNumbered) {
  const Mesh mesh = skirt();
  std::mt19937 random(7);
  std::vector<std::uint32_t> renamed(mesh.positions.size()), order(mesh.triangles.size());
  std::iota(renamed.begin(), renamed.end(), 0u), std::iota(order.begin(), order.end(), 0u);
  std::shuffle(renamed.begin(), renamed.end(), random), std::shuffle(order.begin(), order.end(), random);
  Mesh shuffled{std::vector<Vec3>(mesh.positions.size()), {}};
  for (std::size_t i = 0; i < renamed.size(); ++i) shuffled.positions[renamed[i]] = mesh.positions[i];
  for (std::size_t t = 0; t < order.size(); ++t) {
    const Triangle& from = mesh.triangles[order[t]];
    shuffled.triangles.push_back({renamed[from[t % 3]], renamed[from[(t + 1) % 3]], renamed[from[(t + 2) % 3]]});
  }
  const float c = std::cos(1.1f), q = std::sin(1.1f);
  const auto carry = [&](const Vec3& v) {  // turned about z, then about x, then shifted
    const Vec3 w{c * v.x - q * v.y, q * v.x + c * v.y, v.z};
    return Vec3{w.x + 0.3f, c * w.y - q * w.z - 0.2f, q * w.y + c * w.z + 0.1f};
  };

  for (const SurfaceMode mode : kModes) {
    Surface a(mesh, GetParam()), b(shuffled, GetParam());
    a.mode = b.mode = mode;
    a.move(pressed), a.jitter(0.01f, 5);
    for (std::size_t i = 0; i < renamed.size(); ++i) b.position.view().set(renamed[i], carry(a.position.view()[i]));
    a.run(), b.run();
    // Corner k of face t of b is corner t + k of face order[t] of a.
    float worst = 0.0f;
    for (std::uint32_t t = 0; t < order.size(); ++t) {
      const TessellationPattern& p = a.pattern;
      const std::uint32_t* of_a = &p.face_vertices[order[t] * p.vertices_per_face];
      const std::uint32_t* of_b = &b.pattern.face_vertices[t * p.vertices_per_face];
      for (std::uint32_t v = 0; v < p.vertices_per_face; ++v) {
        const std::array<float, 3>& at = p.face_weights[v];
        std::uint32_t same = 0;  // the vertex of a with the same barycentrics
        const auto distance = [&](std::uint32_t w) {
          float sum = 0.0f;
          for (std::size_t k = 0; k < 3; ++k) sum += std::abs(p.face_weights[w][(k + t) % 3] - at[k]);
          return sum;
        };
        while (distance(same) > 1e-3f) ++same;
        worst = std::max(worst, length(carry(a.drawn.view()[of_a[same]]) - b.drawn.view()[of_b[v]]));
      }
    }
    // The paper's bisection stops within 0.1 % of a length of 0.1 m, on either side.
    EXPECT_LT(worst, mode == SurfaceMode::kPaper ? 2e-3f : 3e-5f) << static_cast<int>(mode);
  }
}

TEST_P(SurfaceProperty, NoDrawnVertexMovesMuchFurtherThanTheParticleThatMoves) {
  for (const SurfaceMode mode : kModes) {
    if (mode == SurfaceMode::kPaper) continue;  // its folds pop: force normals turn at random where forces are tiny
    Surface before(skirt(), GetParam()), after(skirt(), GetParam());
    before.mode = after.mode = mode;
    before.move(pressed), before.jitter(0.01f, 5);
    before.run();
    constexpr float kStep = 1e-4f;  // m
    for (std::uint32_t i = 0; i < before.garment.particle_count; i += 5) {
      for (std::uint32_t p = 0; p < before.garment.particle_count; ++p) {
        const Vec3 step = i == p ? Vec3{0.6f, 0.64f, 0.48f} * kStep : Vec3{};
        after.position.view().set(p, before.position.view()[p] + step);
      }
      after.follow(before, 1e-5f);  // s: of the motion only what is not the folds' own, which takes its time
      after.run();
      float moved = 0.0f;
      for (std::uint32_t v = 0; v < before.pattern.vertex_count; ++v) {
        moved = std::max(moved, length(after.drawn.view()[v] - before.drawn.view()[v]));
      }
      EXPECT_LT(moved, 8.0f * kStep) << "particle " << i << ", mode " << static_cast<int>(mode);
    }
  }
}

TEST_P(SurfaceProperty, PleatIsPnBitForBitWhereNothingIsShort) {
  for (const float stretch : {1.0f, 1.03f}) {
    Surface pleat(skirt(), GetParam()), pn(skirt(), GetParam());
    pn.mode = SurfaceMode::kPn;
    for (Surface* s : {&pleat, &pn}) {
      s->move([&](const Vec3& x) { return x * stretch; });
      s->run();
    }
    for (std::uint32_t v = 0; v < pn.pattern.vertex_count; ++v) {
      EXPECT_EQ(pleat.drawn.view()[v], pn.drawn.view()[v]);
      EXPECT_EQ(pleat.drawn_normal.view()[v], pn.drawn_normal.view()[v]);
    }
  }
}

TEST_P(SurfaceProperty, ACreasedCubeStaysACube) {
  for (const SurfaceMode mode : {SurfaceMode::kFlat, SurfaceMode::kPn, SurfaceMode::kPleat, SurfaceMode::kArcPn}) {
    Surface s(garment_of(make_cube(), 1.0f), GetParam()), round(make_cube(), GetParam());
    s.mode = round.mode = mode;
    s.run(), round.run();
    float most = 0.0f, least = 1.0f, roundest = 1.0f;
    const auto reach = [](const Vec3& x) { return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}); };
    for (std::uint32_t v = 0; v < s.pattern.vertex_count; ++v) {
      most = std::max(most, std::abs(reach(s.drawn.view()[v]) - 0.5f));
    }
    for (std::uint32_t v = 0; v < s.pattern.shaded_count(); ++v)
      least = std::min(least, reach(s.drawn_normal.view()[v]));
    for (std::uint32_t v = 0; v < round.pattern.shaded_count(); ++v) {
      roundest = std::min(roundest, reach(round.drawn_normal.view()[v]));
    }
    EXPECT_LT(most, 1e-6f) << static_cast<int>(mode);     // every vertex on a side
    EXPECT_GT(least, 0.9999f) << static_cast<int>(mode);  // with that side's normal
    EXPECT_LT(roundest, 0.6f);                            // not so without creases
    EXPECT_EQ(s.pattern.shaded_count(), s.pattern.vertex_count + 12 * (s.pattern.segments - 1) + 2 * 8);
  }
}

TEST_P(SurfaceProperty, CreasedClothIsClosedAndShadedApartAlongItsCreases) {
  for (const SurfaceMode mode : kModes) {
    Surface s(garment_of(skirt(), 0.45f), GetParam());  // the skirt's upper rings turn by more
    ASSERT_GT(s.garment.crease_count, 5u);
    ASSERT_LT(s.garment.crease_count, s.garment.hinge_count / 2);
    s.mode = mode;
    s.move(pressed), s.jitter(0.01f, 5);
    s.run();
    const TessellationPattern& p = s.pattern;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;  // by place
    std::vector<bool> used(p.shaded_count());
    for (std::size_t t = 0; t < p.indices.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        sides.emplace_back(p.place(p.indices[t + k]), p.place(p.indices[t + (k + 1) % 3]));
        used[p.indices[t + k]] = true;
      }
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    std::sort(sides.begin(), sides.end());
    EXPECT_EQ(std::adjacent_find(sides.begin(), sides.end()), sides.end());
    const auto open = std::count_if(sides.begin(), sides.end(), [&](const auto& side) {
      return !std::binary_search(sides.begin(), sides.end(), std::pair(side.second, side.first));
    });
    EXPECT_EQ(open, s.garment.border_edge_count * p.segments);
    for (std::uint32_t v = 0; v < p.shaded_count(); ++v) {
      EXPECT_TRUE(is_finite(s.drawn.view()[p.place(v)]));
      EXPECT_NEAR(length(s.drawn_normal.view()[v]), 1.0f, 1e-5f);
    }
    std::uint32_t apart = 0;
    for (std::uint32_t v = p.vertex_count; v < p.shaded_count(); ++v) {
      apart += s.drawn_normal.view()[v] != s.drawn_normal.view()[p.place(v)];
    }
    EXPECT_GT(apart, p.twins.size() * 9 / 10);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, SurfaceProperty, testing::Values(0u, 1u, 2u, 5u, 8u));

}  // namespace
}  // namespace pleat
