#include "components/garment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/components/failing_memory.h"
#include "tests/components/skirt.h"

namespace pleat {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
std::pmr::memory_resource* heap() { return std::pmr::new_delete_resource(); }

Garment garment_of(const Mesh& mesh, std::span<const std::uint32_t> pins = {},
                   std::span<const std::array<std::uint32_t, 2>> seams = {}) {
  return build_garment({mesh.positions, mesh.triangles, {}, pins, seams}, heap());
}

/// Two unit right-angled faces over the edge 0-1, the second turned up by `angle` from the plane of the first.
Mesh hinge(float angle) {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, std::sin(angle), std::cos(angle)}}, {{0, 1, 2}, {1, 0, 3}}};
}

std::uint32_t find_edge(const Garment& g, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    if (g.edge_particle[0][e] == std::min(a, b) && g.edge_particle[1][e] == std::max(a, b)) return e;
  }
  return kNone;
}

TEST(Garment, SkirtHasTheCountsOfTheWorkloads) {
  const Garment g = garment_of(make_skirt());
  EXPECT_EQ(g.particle_count, 66u);
  EXPECT_EQ(g.face_count, 108u);
  EXPECT_EQ(g.edge_count, 174u);
  EXPECT_EQ(g.border_edge_count, 24u);
  EXPECT_EQ(g.hinge_count, 150u);
}

TEST(Garment, EulerNumberTellsATubeFromASheet) {
  const auto euler = [](const Garment& g) {
    return static_cast<int>(g.particle_count) - static_cast<int>(g.edge_count) + static_cast<int>(g.face_count);
  };
  EXPECT_EQ(euler(garment_of(make_skirt())), 0);
  EXPECT_EQ(euler(garment_of(make_grid({.rows = 5, .columns = 7}))), 1);
}

TEST(Garment, EdgesAreUniqueAndKnowTheirFaces) {
  const Mesh mesh = make_skirt();
  const Garment g = garment_of(mesh);
  std::set<std::array<std::uint32_t, 2>> seen;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::array<std::uint32_t, 2> edge{g.edge_particle[0][e], g.edge_particle[1][e]};
    EXPECT_LT(edge[0], edge[1]);
    EXPECT_TRUE(seen.insert(edge).second);
    EXPECT_FLOAT_EQ(g.edge_rest_length[e], length(mesh.positions[edge[1]] - mesh.positions[edge[0]]));
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t f = g.edge_face[side][e];
      if (f == kNone) continue;
      EXPECT_EQ((std::set{g.face_edge[0][f], g.face_edge[1][f], g.face_edge[2][f]}).count(e), 1u);
    }
  }
}

TEST(Garment, EveryEdgeHasASlotButThoseBetweenPins) {
  const Mesh mesh = make_skirt();
  const std::uint32_t pins[] = {0, 1, 2, 3, 4, 5, 6, 7};  // the waist
  const Garment g = build_garment({mesh.positions, mesh.triangles, {}, pins, {}}, std::pmr::new_delete_resource());
  std::set<std::array<std::uint32_t, 2>> slotted;
  for (std::uint32_t s = 0; s < g.slots.count; ++s) {
    const std::uint32_t i = g.slots.particle(0, s), j = g.slots.particle(1, s);
    if (i == g.slots.empty_place) continue;
    EXPECT_TRUE(slotted.insert({i, j}).second);
    EXPECT_FLOAT_EQ(g.slots.rest_length[s], length(mesh.positions[j] - mesh.positions[i]));
  }
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::array<std::uint32_t, 2> edge{g.edge_particle[0][e], g.edge_particle[1][e]};
    EXPECT_EQ(slotted.contains(edge), edge[1] > 7) << e;
  }
  EXPECT_EQ(g.slots.edge_count, 166u);
  EXPECT_EQ(slotted.size(), 166u);
}

TEST(Garment, FaceEdgesJoinTheirCorners) {
  const Garment g = garment_of(make_skirt());
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t e = find_edge(g, g.face_particle[k][f], g.face_particle[(k + 1) % 3][f]);
      EXPECT_EQ(g.face_edge[k][f], e);
      EXPECT_TRUE(g.edge_face[0][e] == f || g.edge_face[1][e] == f);
    }
  }
}

TEST(Garment, AreaIsSharedOutInThirds) {
  const Garment g = garment_of(make_grid({.rows = 4, .columns = 4, .width = 3.0f, .depth = 6.0f}));
  EXPECT_FLOAT_EQ(g.area, 18.0f);
  for (std::uint32_t f = 0; f < g.face_count; ++f) EXPECT_FLOAT_EQ(g.face_rest_area[f], 1.0f);
  EXPECT_FLOAT_EQ(g.particle_area[0], 2.0f / 3.0f);  // two faces meet in the corner
  EXPECT_FLOAT_EQ(g.particle_area[3], 1.0f / 3.0f);  // one
  EXPECT_FLOAT_EQ(g.particle_area[5], 2.0f);         // six
  float sum = 0.0f;
  for (const float a : g.particle_area) sum += a;
  EXPECT_FLOAT_EQ(sum, g.area);
}

TEST(Garment, MeanEdgeLengthIsTheMean) {
  const Garment g = garment_of({{{0, 0, 0}, {3, 0, 0}, {0, 0, -4}}, {{0, 1, 2}}});
  EXPECT_FLOAT_EQ(g.mean_edge_length, 4.0f);
}

TEST(Garment, FacesAroundAParticleAreListedOnceAscending) {
  const Garment g = garment_of(make_skirt());
  ASSERT_EQ(g.around_begin.size(), g.particle_count + 1u);
  EXPECT_EQ(g.around_begin[g.particle_count], 3 * g.face_count);
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    const std::uint32_t* begin = g.faces_around.begin() + g.around_begin[i];
    const std::uint32_t* end = g.faces_around.begin() + g.around_begin[i + 1];
    EXPECT_TRUE(std::is_sorted(begin, end));
    EXPECT_EQ(std::adjacent_find(begin, end), end);
    for (const std::uint32_t* f = begin; f != end; ++f) {
      EXPECT_TRUE(g.face_particle[0][*f] == i || g.face_particle[1][*f] == i || g.face_particle[2][*f] == i);
    }
  }
}

TEST(Garment, HingeRunsInTheWindingOfItsFirstFace) {
  const Garment g = garment_of(make_skirt());
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    const std::uint32_t p[4] = {g.hinge_particle[0][h], g.hinge_particle[1][h], g.hinge_particle[2][h],
                                g.hinge_particle[3][h]};
    const std::uint32_t e = find_edge(g, p[0], p[1]);
    ASSERT_NE(e, kNone);
    const auto has_side = [&](std::uint32_t f, std::uint32_t from, std::uint32_t to, std::uint32_t tip) {
      for (int k = 0; k < 3; ++k) {
        if (g.face_particle[k][f] == from && g.face_particle[(k + 1) % 3][f] == to) {
          return g.face_particle[(k + 2) % 3][f] == tip;
        }
      }
      return false;
    };
    EXPECT_TRUE(has_side(g.edge_face[0][e], p[0], p[1], p[2]));
    EXPECT_TRUE(has_side(g.edge_face[1][e], p[1], p[0], p[3]));
  }
}

TEST(Garment, HingeKnowsItsAngle) {
  for (const float angle : {0.0f, 0.3f, -0.3f, 1.5f, -3.0f}) {
    const Garment g = garment_of(hinge(angle));
    ASSERT_EQ(g.hinge_count, 1u);
    EXPECT_NEAR(std::abs(g.hinge_rest_angle[0]), std::abs(angle), 1e-6f);
  }
  EXPECT_LT(garment_of(hinge(0.3f)).hinge_rest_angle[0] * garment_of(hinge(-0.3f)).hinge_rest_angle[0], 0.0f);
}

TEST(Garment, CylinderTurnsByTheSameAngleAtEachPanel) {
  constexpr std::uint32_t n = 12;
  const std::array<Ring, 2> rings{{{n, 1.0f, 0.5f}, {n, 1.0f, -0.5f}}};
  const Garment g = garment_of(make_rings(rings));
  std::uint32_t flat = 0, turned = 0;
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    const float angle = std::abs(g.hinge_rest_angle[h]);
    if (angle < 1e-5f) {
      ++flat;  // the diagonal of a panel
    } else {
      EXPECT_NEAR(angle, 2.0f * kPi / n, 1e-5f);
      EXPECT_GT(g.hinge_rest_angle[h] * g.hinge_rest_angle[g.hinge_count - 1] + 1e-12f, 0.0f);
      ++turned;
    }
  }
  EXPECT_EQ(flat, n);
  EXPECT_EQ(turned, n);
}

TEST(Garment, PinsKeepTheHostsOrder) {
  const std::uint32_t pins[] = {5, 0, 2};
  const Garment g = garment_of(make_grid({.rows = 3, .columns = 3}), pins);
  EXPECT_EQ((std::vector<std::uint32_t>(g.pins.begin(), g.pins.end())), (std::vector<std::uint32_t>{5, 0, 2}));
  for (std::uint32_t i = 0; i < 9; ++i) EXPECT_EQ(g.pinned[i], i == 5 || i == 0 || i == 2 ? 1 : 0);
}

TEST(Garment, SeamsAreMarkedInEitherDirection) {
  const std::array<std::uint32_t, 2> seams[] = {{4, 1}, {3, 4}, {0, 8}, {0, 1}};  // no edge, and one on the border
  const Garment g = garment_of(make_grid({.rows = 3, .columns = 3}), {}, seams);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    EXPECT_EQ(g.edge_is_crease[e] != 0, e == find_edge(g, 1, 4) || e == find_edge(g, 3, 4)) << e;
  }
}

TEST(Garment, UnreferencedVertexIsInert) {
  Mesh mesh = make_grid({.rows = 2, .columns = 2});
  mesh.positions.push_back({9, 9, 9});
  const Garment g = garment_of(mesh);
  EXPECT_EQ(g.particle_area[4], 0.0f);
  EXPECT_EQ(g.around_begin[4], g.around_begin[5]);
}

TEST(Garment, GivesAllBackWhenMemoryRunsOut) {
  const Mesh mesh = make_skirt();
  const GarmentInput input{mesh.positions, mesh.triangles, {}, {}, {}};
  int allowed = 0;
  for (;; ++allowed) {
    FailingMemory memory(allowed);
    try {
      const Garment g = build_garment(input, &memory);
      EXPECT_EQ(g.edge_count, 174u);
      break;
    } catch (const std::bad_alloc&) {
    }
    EXPECT_EQ(memory.live(), 0);
  }
  EXPECT_GT(allowed, 20);
}

}  // namespace
}  // namespace pleat
