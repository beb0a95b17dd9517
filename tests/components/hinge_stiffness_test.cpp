#include "components/hinge_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "components/shapes.h"

namespace pleat {
namespace {

Garment garment_of(const Mesh& mesh) {
  return build_garment({mesh.positions, mesh.triangles, {}, {}, {}}, std::pmr::new_delete_resource());
}

/// Of the hinges turned by `turn`, over B.
double energy(const Garment& g, const std::vector<double>& turn) {
  double sum = 0.0;
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    sum += 0.5 * turn[h] * double(g.hinge_shape[h]) * turn[h];
    for (std::size_t k = 0; k < 4; ++k) {
      sum += 0.5 * turn[h] * double(g.hinge_coupling[k][h]) * turn[g.hinge_beside[k][h]];
    }
  }
  return sum;
}

/// Of the unit normals of faces, in double.
double angle_of(const Garment& g, const std::vector<Vec3T<double>>& x, std::uint32_t h) {
  const auto at = [&](std::size_t k) { return x[g.hinge_particle[k][h]]; };
  const auto e = at(1) - at(0), na = cross(e, at(2) - at(0)), nb = cross(at(3) - at(0), e);
  return std::atan2(dot(cross(na, nb), e) / length(e), dot(na, nb));
}

struct Curvature {
  double xx, zz, xz;
  double size2() const { return xx * xx + zz * zz + 2 * xz * xz; }
};

/// How far a flat sheet's hinges turn when it is bent a little, per unit of that.
std::vector<double> turns(const Garment& g, const Curvature& k) {
  constexpr double kLittle = 1e-5;
  std::vector<Vec3T<double>> x(g.particle_count);
  const ConstVec3View rest = g.rest_position.view();
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    const double u = double(rest[i].x), w = double(rest[i].z);
    x[i] = {u, kLittle * (0.5 * k.xx * u * u + 0.5 * k.zz * w * w + k.xz * u * w), w};
  }
  std::vector<double> turn(g.hinge_count);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) turn[h] = angle_of(g, x, h) / kLittle;
  return turn;
}

/// Of all faces; of those with three hinges.
struct Areas {
  double all = 0.0, inner = 0.0;
};
Areas areas(const Garment& g) {
  Areas sum;
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const double area = double(g.face_rest_area[f]);
    bool inner = true;
    for (const auto& edge : g.face_edge) inner = inner && g.edge_face[1][edge[f]] != kNone;
    sum.all += area;
    if (inner) sum.inner += area;
  }
  return sum;
}

Mesh skewed(Mesh mesh, float shear, float shrink) {
  for (Vec3& x : mesh.positions) x = {x.x + shear * x.z, 0.0f, shrink * x.z};
  return mesh;
}

Mesh uneven(Mesh mesh, float most) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const float k = static_cast<float>(i);
    mesh.positions[i] += {most * std::sin(7.0f * k), 0.0f, most * std::cos(5.0f * k)};
  }
  return mesh;
}

TEST(HingeStiffness, OfOneHingeIsItsEdgeSquaredOverBothAreas) {
  const Garment g = garment_of({{{0, 0, 0}, {2, 0, 0}, {0, 0, -1}, {0, 0, 5}}, {{0, 1, 2}, {1, 0, 3}}});
  EXPECT_FLOAT_EQ(g.hinge_shape[0], 4.0f / (1.0f + 5.0f));
  EXPECT_FLOAT_EQ(g.hinge_bound[0], g.hinge_shape[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(g.hinge_beside[k][0], 0u);
    EXPECT_EQ(g.hinge_coupling[k][0], 0.0f);
  }
}

TEST(HingeStiffness, CouplesBothWaysAlike) {
  const Garment g = garment_of(uneven(make_grid({.rows = 5, .columns = 6}), 0.02f));
  std::uint32_t coupled = 0;
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    float bound = g.hinge_shape[h];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t other = g.hinge_beside[k][h];
      bound += std::abs(g.hinge_coupling[k][h]);
      if (other == h) {
        EXPECT_EQ(g.hinge_coupling[k][h], 0.0f);
        continue;
      }
      float back = 0.0f;
      for (std::size_t l = 0; l < 4; ++l) {
        if (g.hinge_beside[l][other] == h) back = g.hinge_coupling[l][other];
      }
      EXPECT_EQ(back, g.hinge_coupling[k][h]);
      ++coupled;
    }
    EXPECT_NEAR(g.hinge_bound[h], bound, 1e-5f * bound);
  }
  EXPECT_GT(coupled, 2 * g.hinge_count);
}

TEST(HingeStiffnessProperty, AnyCurvatureHasThePlatesEnergyOnAnyMesh) {
  constexpr std::uint32_t n = 14;
  const Mesh grid = make_grid({.rows = n, .columns = n});
  const Mesh alternate = make_grid({.rows = n, .columns = n, .alternate = true});
  const Mesh meshes[] = {grid,
                         alternate,
                         skewed(grid, -0.5f, std::sqrt(0.75f)),
                         skewed(grid, 0.3f, 0.6f),
                         uneven(grid, 0.005f),
                         uneven(alternate, 0.01f)};
  for (const Mesh& mesh : meshes) {
    const Garment g = garment_of(mesh);
    const Areas area = areas(g);
    for (const Curvature& k :
         {Curvature{1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0.5}, {0.5, 0.5, -0.5}, {1, 1, 0}, {1, -1, 0}}) {
      const double plate = 0.5 * k.size2(), bent = energy(g, turns(g, k));
      const auto which = &mesh - meshes;
      EXPECT_GE(bent, 0.9999 * plate * area.inner) << which << ": " << k.xx << ' ' << k.zz << ' ' << k.xz;
      EXPECT_LE(bent, 1.0001 * plate * area.all) << which << ": " << k.xx << ' ' << k.zz << ' ' << k.xz;
    }
  }
}

TEST(HingeStiffnessProperty, TurnsThatAreNoCurvatureCostEnergyToo) {
  std::mt19937 random(3);
  const Mesh meshes[] = {make_grid({.rows = 6, .columns = 6}), uneven(make_grid({.rows = 6, .columns = 6}), 0.05f)};
  for (const Mesh& mesh : meshes) {
    const Garment g = garment_of(mesh);
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<double> turn(g.hinge_count);
      double alone = 0.0;
      for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
        turn[h] = double(random()) / double(std::mt19937::max()) - 0.5;
        alone += 0.5 * double(g.hinge_shape[h]) * turn[h] * turn[h];
      }
      EXPECT_GT(energy(g, turn), 0.05 * alone);
    }
  }
}

TEST(HingeStiffness, StaysFiniteWhereTurnsDoNotTellCurvature) {
  // A face and its three neighbours with all corners on a circle: bent to a dome, none of its hinges turns.
  Mesh mesh{{}, {{0, 2, 4}, {0, 1, 2}, {2, 3, 4}, {4, 5, 0}}};
  for (int i = 0; i < 6; ++i) {
    const float angle = 1.0471976f * static_cast<float>(i);
    mesh.positions.push_back({std::sin(angle), 0.0f, std::cos(angle)});
  }
  const Garment g = garment_of(mesh);
  ASSERT_EQ(g.hinge_count, 3u);
  for (std::uint32_t h = 0; h < 3; ++h) {
    EXPECT_GT(g.hinge_shape[h], 0.0f);
    EXPECT_LT(g.hinge_bound[h], 60.0f);  // one such hinge alone: |e|^2 / (A1 + A2) = 1.7
  }
  EXPECT_GT(energy(g, {1.0, 1.0, 1.0}), 0.0);
  EXPECT_GT(energy(g, {1.0, -1.0, 0.0}), 0.0);
}

TEST(HingeStiffness, FaceWithoutAreaBendsNothing) {
  const Garment g = garment_of({{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0.5f, 0, 0}}, {{0, 1, 2}, {1, 0, 3}}});
  ASSERT_EQ(g.hinge_count, 1u);
  EXPECT_EQ(g.hinge_shape[0], 0.0f);
  EXPECT_EQ(g.hinge_bound[0], 0.0f);
}

}  // namespace
}  // namespace pleat
