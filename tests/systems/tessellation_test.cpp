#include "systems/tessellation.h"

#include <gtest/gtest.h>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

constexpr SurfaceMode kModes[] = {SurfaceMode::kFlat,  SurfaceMode::kPn,    SurfaceMode::kPaper,
                                  SurfaceMode::kPleat, SurfaceMode::kPhong, SurfaceMode::kSpherigon,
                                  SurfaceMode::kArcPn};

/// Largest distance between the drawn vertices of two surfaces of the same pattern, after mapping the first's.
template <class F>
float largest_difference(const Surface& a, const Surface& b, F map) {
  float largest = 0.0f;
  for (std::uint32_t i = 0; i < a.pattern.vertex_count; ++i) {
    largest = std::max(largest, length(map(a.drawn.view()[i]) - b.drawn.view()[i]));
  }
  return largest;
}
float largest_difference(const Surface& a, const Surface& b) {
  return largest_difference(a, b, [](const Vec3& x) { return x; });
}

/// The skirt pressed together and crumpled a little: about half of its edges are short.
Surface crumpled(SurfaceMode mode, std::uint32_t level = 0) {
  Surface s(skirt(), level);
  s.mode = mode;
  s.move([](const Vec3& x) { return Vec3{0.85f * x.x, x.y, x.z}; });
  s.jitter(0.01f, 5);
  s.run();
  return s;
}

TEST(Tessellation, ReproducesAFlatSheet) {
  for (const SurfaceMode mode : kModes) {
    for (const std::uint32_t level : {0u, 1u, 3u}) {
      Surface s(sheet(4), level), flat(sheet(4), level);
      s.mode = mode;
      flat.mode = SurfaceMode::kFlat;
      s.run(), flat.run();
      for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) EXPECT_EQ(s.drawn.view()[i].y, 0.0f);
      EXPECT_LT(largest_difference(s, flat), 1e-6f);
    }
  }
}

TEST(Tessellation, GoesThroughTheParticles) {
  for (const SurfaceMode mode : kModes) {
    const Surface s = crumpled(mode);
    for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) EXPECT_EQ(s.drawn.view()[i], s.position.view()[i]);
  }
}

/// A sheet on a ball of radius r with the ball's own normals: how far from it each surface is drawn, RMS, m.
double off_the_ball(SurfaceMode mode, float r) {
  Surface s(sheet(6), 3);
  s.mode = mode;
  s.move([&](const Vec3& x) { return normalized_or(Vec3{x.x, 0.6f, x.z}, {}) * r; });
  for (std::uint32_t i = 0; i < s.garment.particle_count; ++i)
    s.normal.view().set(i, s.position.view()[i] * (1.0f / r));
  s.tessellation().run();
  double sum = 0.0;
  for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) {
    const double off = double(length(s.drawn.view()[i])) - double(r);
    sum += off * off;
  }
  return std::sqrt(sum / s.pattern.vertex_count);
}

TEST(Tessellation, AlternativesOnABallAreAsGoodAsTheyShould) {
  const float r = 0.5f;
  const double flat = off_the_ball(SurfaceMode::kFlat, r), pn = off_the_ball(SurfaceMode::kPn, r);
  EXPECT_LT(off_the_ball(SurfaceMode::kSpherigon, r), 1e-6);  // its points are on every ball, by construction
  EXPECT_LT(pn, 0.06 * flat);
  EXPECT_LT(off_the_ball(SurfaceMode::kArcPn, r), 0.4 * pn);
  // Three quarters of the way to the tangent planes; half of it would be the ball's curvature.
  EXPECT_NEAR(off_the_ball(SurfaceMode::kPhong, r) / flat, 0.5, 0.07);
}

class TessellationLevel : public testing::TestWithParam<std::uint32_t> {};

TEST_P(TessellationLevel, EdgeVerticesDependOnTheEdgeAlone) {
  // Each face cut out and drawn on its own gives the same bits along its sides: neighbours cannot come apart.
  for (const SurfaceMode mode : kModes) {
    Surface s = crumpled(mode, GetParam());
    for (std::uint32_t f = 0; f < s.garment.face_count; ++f) {
      std::array<std::uint32_t, 3> p{s.garment.face_particle[0][f], s.garment.face_particle[1][f],
                                     s.garment.face_particle[2][f]};
      std::sort(p.begin(), p.end());
      Mesh one;
      for (const std::uint32_t i : p) one.positions.push_back(s.garment.rest_position.view()[i]);
      one.triangles.push_back({0, 1, 2});
      Surface cut(one, GetParam());
      cut.mode = mode;
      for (std::uint32_t i = 0; i < 3; ++i) {
        cut.position.view().set(i, s.position.view()[p[i]]);
        cut.normal.view().set(i, s.normal.view()[p[i]]);
      }
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t e = s.garment.face_edge[k][f];
        const auto own = [&](int end) {
          return std::find(p.begin(), p.end(), s.garment.edge_particle[end][e]) - p.begin();
        };
        std::uint32_t same = 0;
        while (cut.garment.edge_particle[0][same] != own(0) || cut.garment.edge_particle[1][same] != own(1)) ++same;
        cut.fold.view().set(same, s.fold.view()[e]);
        cut.fold_height[same] = s.fold_height[e];
        cut.tessellation().run();
        for (std::uint32_t step = 1; step < s.pattern.segments; ++step) {
          EXPECT_EQ(cut.drawn.view()[cut.pattern.edge_vertex(same, step)],
                    s.drawn.view()[s.pattern.edge_vertex(e, step)]);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, TessellationLevel, testing::Range(0u, 9u));

TEST(Tessellation, PleatIsPnOnFacesWithoutFolds) {
  Surface pleat(skirt(), 2);
  pleat.jitter(0.012f, 9);
  pleat.run();
  Surface pn(skirt(), 2);
  pn.mode = SurfaceMode::kPn;
  for (std::uint32_t i = 0; i < pn.garment.particle_count; ++i) {
    pn.position.view().set(i, pleat.position.view()[i]);
    pn.normal.view().set(i, pleat.normal.view()[i]);
  }
  pn.tessellation().run();
  int smooth = 0, folded = 0;
  for (std::uint32_t f = 0; f < pn.garment.face_count; ++f) {
    bool any = false;
    for (const auto& edge : pn.garment.face_edge) any |= pleat.fold_height[edge[f]] != 0.0f;
    ++(any ? folded : smooth);
    bool equal = true;
    for (std::uint32_t v = 0; v < pn.pattern.vertices_per_face; ++v) {
      const std::uint32_t i = pn.pattern.face_vertices[f * pn.pattern.vertices_per_face + v];
      equal &= pn.drawn.view()[i] == pleat.drawn.view()[i];
    }
    EXPECT_EQ(equal, !any);
  }
  EXPECT_GT(smooth, 0);
  EXPECT_GT(folded, 0);
}

TEST(Tessellation, TellsHowFarTheVerticesOfFacesAreFromTheFlatTriangles) {
  for (const SurfaceMode mode : {SurfaceMode::kPn, SurfaceMode::kPleat, SurfaceMode::kArcPn}) {
    for (const float crease_angle : {4.0f, 0.5f}) {
      for (const std::uint32_t level : {0u, 1u, 2u, 5u}) {
        Surface s(garment_of(skirt(), crease_angle), level);
        s.mode = mode;
        s.jitter(0.012f, 5);
        s.run();
        for (std::uint32_t f = 0; f < s.garment.face_count; ++f) {
          const std::uint32_t* vertex = &s.pattern.face_vertices[f * s.pattern.vertices_per_face];
          float furthest = 0.0f;
          for (std::uint32_t v = 0; v < s.pattern.vertices_per_face; ++v) {
            Vec3 flat{};
            for (std::size_t k = 0; k < 3; ++k) {
              flat += s.position.view()[s.garment.face_particle[k][f]] * s.pattern.face_weights[v][k];
            }
            furthest = std::max(furthest, length(s.drawn.view()[vertex[v]] - flat));
          }
          EXPECT_GT(furthest, 1e-4f);
          EXPECT_NEAR(s.bulge[f], furthest, 1e-6f);
        }
      }
    }
  }
}

TEST(Tessellation, CurvesThatFoldSidesLeftGiveTheSameBits) {
  const Surface anew = crumpled(SurfaceMode::kPleat, 3);
  Surface s = crumpled(SurfaceMode::kPleat, 3);
  clear(s.drawn.view(), s.pattern.vertex_count);
  Tessellation shared = s.tessellation();
  shared.curves = s.choices.curves.data();
  shared.run();
  for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) EXPECT_EQ(s.drawn.view()[i], anew.drawn.view()[i]) << i;
}

TEST(Tessellation, FoldsOverAFlatFaceAreThePapersFourPatches) {
  // With upright normals the four rebuilt PN triangles and the bump field are the same cubics.
  for (const std::uint32_t level : {0u, 2u, 5u}) {
    Surface paper(sheet(3), level), pleat(sheet(3), level);
    paper.mode = SurfaceMode::kPaper;
    for (Surface* s : {&paper, &pleat}) {
      for (std::uint32_t i = 0; i < s->garment.particle_count; ++i) s->normal.view().set(i, {0, 1, 0});
      for (std::uint32_t e = 0; e < s->garment.edge_count; ++e) {
        s->fold.view().set(e, {0, 1, 0});
        s->fold_height[e] = 0.02f * static_cast<float>(e % 5);
      }
      s->tessellation().run();
    }
    EXPECT_LT(largest_difference(paper, pleat), 1e-6f);
  }
}

TEST(Tessellation, DrawnEdgesHaveTheirRestLength) {
  for (const SurfaceMode mode : {SurfaceMode::kPaper, SurfaceMode::kPleat}) {
    const Surface s = crumpled(mode, 8);
    const bool paper = mode == SurfaceMode::kPaper;
    double least = 1.0, sum = 0.0;
    int folded = 0;
    for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
      if (std::abs(s.fold_height[e]) < 0.05f * s.garment.edge_rest_length[e]) continue;
      double l = 0.0;
      Vec3 last = s.position.view()[s.garment.edge_particle[0][e]];
      for (std::uint32_t step = 1; step <= s.pattern.segments; ++step) {
        const Vec3 next = step < s.pattern.segments ? s.drawn.view()[s.pattern.edge_vertex(e, step)]
                                                    : s.position.view()[s.garment.edge_particle[1][e]];
        l += static_cast<double>(length(next - last));
        last = next;
      }
      l /= paper ? s.garment.edge_rest_length[e] : s.garment.edge_rest_curve_length[e];
      EXPECT_LT(l, 1.005);
      least = std::min(least, l), sum += l;
      ++folded;
    }
    EXPECT_GT(folded, 50);
    EXPECT_GT(least, paper ? 0.995 : 0.85);         // 16 chords a drawn edge
    EXPECT_GT(sum / folded, paper ? 0.998 : 0.97);  // pleat holds back where the edge is straight
  }
}

TEST(Tessellation, TurnsWithTheCloth) {
  const float c = std::cos(1.1f), q = std::sin(1.1f);
  const auto rotate = [&](const Vec3& v) {  // about z, then about x
    const Vec3 w{c * v.x - q * v.y, q * v.x + c * v.y, v.z};
    return Vec3{w.x, c * w.y - q * w.z, q * w.y + c * w.z};
  };
  for (const SurfaceMode mode : kModes) {
    const Surface s = crumpled(mode);
    Surface turned(skirt());
    turned.mode = mode;
    for (std::uint32_t i = 0; i < s.garment.particle_count; ++i)
      turned.position.view().set(i, rotate(s.position.view()[i]));
    turned.run();
    EXPECT_LT(largest_difference(s, turned, rotate), mode == SurfaceMode::kPaper ? 2e-3f : 2e-5f);
  }
}

TEST(Tessellation, DoesNotDependOnWhichCornerIsFirst) {
  Mesh mesh = skirt();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::rotate(mesh.triangles[t].begin(), mesh.triangles[t].begin() + static_cast<int>(t % 3),
                mesh.triangles[t].end());
  }
  for (const SurfaceMode mode : kModes) {
    const Surface s = crumpled(mode);
    Surface turned(mesh);
    turned.mode = mode;
    for (std::uint32_t i = 0; i < s.garment.particle_count; ++i) turned.position.view().set(i, s.position.view()[i]);
    turned.run();
    for (std::uint32_t i = 0; i < s.pattern.first_face_vertex; ++i) {
      EXPECT_LT(length(s.drawn.view()[i] - turned.drawn.view()[i]), mode == SurfaceMode::kPaper ? 1e-3f : 1e-5f);
    }
    for (std::uint32_t f = 0; f < s.garment.face_count; ++f) {  // the centre of the fan keeps its number
      const std::uint32_t i = s.pattern.face_vertex(f, 3);
      EXPECT_LT(length(s.drawn.view()[i] - turned.drawn.view()[i]), mode == SurfaceMode::kPaper ? 1e-3f : 1e-5f);
    }
  }
}

TEST(Tessellation, PleatMovesWithItsParticlesWithoutPopping) {
  // A row of waves that flattens, turns over and rises again, under compression that comes and goes.
  Surface a(sheet(9)), b(sheet(9));
  constexpr int kSteps = 4000;
  float worst = 0.0f;
  for (int i = 0; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    const float height = 0.06f * (1.0f - 2.0f * t), press = 1.0f - 0.15f * std::sin(20.0f * t);
    Surface& now = i % 2 == 0 ? a : b;
    Surface& before = i % 2 == 0 ? b : a;
    for (std::uint32_t p = 0; p < now.garment.particle_count; ++p) {
      const Vec3 x = now.garment.rest_position.view()[p];
      now.position.view().set(p, {x.x * press, height * std::cos(12.566371f * x.x), x.z});
    }
    if (i > 0) now.follow(before, 1e-3f);  // s: the motion takes 4
    now.run();
    if (i == 0) continue;
    float step = 0.0f;
    for (std::uint32_t p = 0; p < now.garment.particle_count; ++p) {
      step = std::max(step, length(now.position.view()[p] - before.position.view()[p]));
    }
    worst = std::max(worst, largest_difference(now, before) / step);
  }
  EXPECT_LT(worst, 3.0f);  // times the fastest particle's motion
}

TEST(Tessellation, DegenerateClothIsFinite) {
  for (const SurfaceMode mode : kModes) {
    for (const float scale : {0.0f, 1e-7f, 0.3f}) {
      Surface s(skirt());
      s.mode = mode;
      s.move([&](const Vec3& x) { return Vec3{x.x * scale, x.y * scale, 0.0f}; });
      s.run();
      for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) {
        EXPECT_TRUE(is_finite(s.drawn.view()[i]));
        EXPECT_LT(length(s.drawn.view()[i]), 3.0f);
        EXPECT_NEAR(length(s.drawn_normal.view()[i]), 1.0f, 1e-5f);
      }
    }
  }
}

TEST(Tessellation, ValidateRefusesWhatIsMissing) {
  Surface s(skirt());
  EXPECT_TRUE(s.tessellation().validate());
  Tessellation t = s.tessellation();
  t.pattern = nullptr;
  EXPECT_FALSE(t.validate());
  t = s.tessellation(), t.garment = nullptr;
  EXPECT_FALSE(t.validate());
  t = s.tessellation(), t.drawn_position = {};
  EXPECT_FALSE(t.validate());
  t = s.tessellation(), t.fold_height = nullptr;
  EXPECT_FALSE(t.validate());
  t.mode = SurfaceMode::kPn, t.fold = {};
  EXPECT_TRUE(t.validate());
  t.normal = {};
  EXPECT_FALSE(t.validate());
  t.mode = SurfaceMode::kFlat;
  EXPECT_FALSE(t.validate());  // flat triangles have no bulge to tell
  t.bulge = nullptr;
  EXPECT_TRUE(t.validate());
}

}  // namespace
}  // namespace pleat
