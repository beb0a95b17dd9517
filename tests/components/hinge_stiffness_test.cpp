#include "components/hinge_stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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

constexpr Curvature kAlong{1, 0, 0}, kAcross{0, 1, 0}, kDiagonal{0.5, 0.5, 0.5}, kOtherDiagonal{0.5, 0.5, -0.5},
    kDome{1, 1, 0}, kSaddle{1, -1, 0};
constexpr Curvature kCurvatures[] = {kAlong, kAcross, kDiagonal, kOtherDiagonal, kDome, kSaddle};

using Heights = std::vector<double>;

/// Of a flat sheet's particles when it is bent.
Heights heights(const Garment& g, const Curvature& k) {
  const ConstVec3View rest = g.rest_position.view();
  Heights y(g.particle_count);
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    const double u = double(rest[i].x), w = double(rest[i].z);
    y[i] = 0.5 * k.xx * u * u + 0.5 * k.zz * w * w + k.xz * u * w;
  }
  return y;
}

/// How far a flat sheet's hinges turn when it is bent a little, per unit of that.
std::vector<double> turns(const Garment& g, const Heights& y) {
  constexpr double kLittle = 1e-5;
  std::vector<Vec3T<double>> x(g.particle_count);
  const ConstVec3View rest = g.rest_position.view();
  for (std::uint32_t i = 0; i < g.particle_count; ++i) x[i] = {double(rest[i].x), kLittle * y[i], double(rest[i].z)};
  std::vector<double> turn(g.hinge_count);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) turn[h] = angle_of(g, x, h) / kLittle;
  return turn;
}
std::vector<double> turns(const Garment& g, const Curvature& k) { return turns(g, heights(g, k)); }

/// On hinges turned by `turn`, over B.
std::vector<double> moments(const Garment& g, const std::vector<double>& turn) {
  std::vector<double> moment(g.hinge_count);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    moment[h] = double(g.hinge_shape[h]) * turn[h];
    for (std::size_t k = 0; k < 4; ++k) moment[h] += double(g.hinge_coupling[k][h]) * turn[g.hinge_beside[k][h]];
  }
  return moment;
}

/// Over B, per area, of the hinges of 8 m amid a sheet.
double inner_energy(const Garment& g, const std::vector<double>& turn) {
  constexpr float kFrom = -4.25f, kTo = 3.75f;  // no hinge of unit squares lies there
  const ConstVec3View rest = g.rest_position.view();
  const std::vector<double> moment = moments(g, turn);
  double sum = 0.0;
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    const Vec3 x = (rest[g.hinge_particle[0][h]] + rest[g.hinge_particle[1][h]]) * 0.5f;
    const bool inside = x.x > kFrom && x.x < kTo && x.z > kFrom && x.z < kTo;
    if (inside) sum += 0.5 * turn[h] * moment[h];
  }
  return sum / double((kTo - kFrom) * (kTo - kFrom));
}

/// Of a sheet of unit squares with alternating diagonals, its particles where eight edges meet moved by `height` per
/// trace of the curvature, the others back.
std::vector<double> zigzag_turns(const Garment& g, const Curvature& k, double height) {
  Heights y = heights(g, k);
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    const Vec3 x = g.rest_position.view()[i];
    const bool eight = std::lround(x.x + x.z) % 2 == 0;
    y[i] += 0.5 * height * (k.xx + k.zz) * (eight ? 1 : -1);
  }
  return turns(g, y);
}

/// Where the inner particles of a bent sheet have come to rest; those less than 2 m from its border are held. By
/// conjugate gradients.
std::vector<double> relaxed_turns(const Garment& g, const Curvature& k) {
  const ConstVec3View rest = g.rest_position.view();
  float border = 0.0f;
  for (std::uint32_t i = 0; i < g.particle_count; ++i) border = std::max(border, std::abs(rest[i].x));
  std::vector<Vec3T<double>> flat(g.particle_count);
  for (std::uint32_t i = 0; i < g.particle_count; ++i) flat[i] = {double(rest[i].x), 0.0, double(rest[i].z)};
  std::vector<std::array<double, 4>> slope(g.hinge_count);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    for (std::size_t i = 0; i < 4; ++i) {
      double& y = flat[g.hinge_particle[i][h]].y;
      y = 1e-5;
      slope[h][i] = angle_of(g, flat, h) / y;
      y = 0.0;
    }
  }
  const auto pull = [&](const Heights& y) {
    const std::vector<double> moment = moments(g, turns(g, y));
    Heights force(g.particle_count, 0.0);
    for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
      for (std::size_t i = 0; i < 4; ++i) force[g.hinge_particle[i][h]] -= slope[h][i] * moment[h];
    }
    for (std::uint32_t i = 0; i < g.particle_count; ++i) {
      if (std::max(std::abs(rest[i].x), std::abs(rest[i].z)) > border - 2.0f) force[i] = 0.0;
    }
    return force;
  };
  const auto product = [](const Heights& a, const Heights& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  Heights y = heights(g, k), left = pull(y), way = left;
  const double first = product(left, left);
  for (double now = first; now > 1e-8 * first;) {
    const Heights back = pull(way);
    const double step = -now / product(way, back);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += step * way[i], left[i] += step * back[i];
    const double next = product(left, left);
    for (std::size_t i = 0; i < y.size(); ++i) way[i] = left[i] + next / now * way[i];
    now = next;
  }
  return turns(g, y);
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

Mesh with_diagonals_by_chance(Mesh mesh) {
  std::mt19937 random(5);
  for (std::size_t f = 0; f + 1 < mesh.triangles.size(); f += 2) {
    const auto [a, c, d] = mesh.triangles[f];
    const std::uint32_t b = mesh.triangles[f + 1][2];
    if (random() % 2 == 0) mesh.triangles[f] = {a, c, b}, mesh.triangles[f + 1] = {b, c, d};
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

TEST(HingeStiffnessProperty, AnyCurvatureHasThePlatesEnergyOnAnyLattice) {
  constexpr std::uint32_t n = 14;
  const Mesh grid = make_grid({.rows = n, .columns = n});
  for (const Mesh& mesh : {grid, skewed(grid, -0.5f, std::sqrt(0.75f)), skewed(grid, 0.3f, 0.6f)}) {
    const Garment g = garment_of(mesh);
    const Areas area = areas(g);
    for (const Curvature& k : kCurvatures) {
      const double plate = 0.5 * k.size2(), bent = energy(g, turns(g, k));
      EXPECT_GE(bent, 0.9999 * plate * area.inner) << k.xx << ' ' << k.zz << ' ' << k.xz;
      EXPECT_LE(bent, 1.0001 * plate * area.all) << k.xx << ' ' << k.zz << ' ' << k.xz;
    }
  }
}

TEST(HingeStiffness, SquaresWithAlternatingDiagonalsZigzagToThePlatesEnergyAtAnyCylinder) {
  constexpr std::uint32_t n = 20;
  const Garment g = garment_of(make_grid({.rows = n + 1, .columns = n + 1, .width = n, .depth = n, .alternate = true}));
  // Where eight edges meet the sheet lies an eighth of the trace lower, where four do as much higher; anything else
  // costs more.
  for (const double height : {0.115, 0.125, 0.135}) {
    const bool rests = height == 0.125;
    for (const Curvature& k : {kAlong, kAcross, kDiagonal, kOtherDiagonal}) {
      const double inner = inner_energy(g, zigzag_turns(g, k, -height));
      if (rests) {
        EXPECT_NEAR(inner, 0.5, 1e-4) << k.xx << ' ' << k.zz << ' ' << k.xz;
      } else {
        EXPECT_GT(inner, 0.501) << k.xx << ' ' << k.zz << ' ' << k.xz;
      }
    }
    // No cylinders: a dome gives way more, a saddle, which is a twist, not at all.
    if (rests) {
      EXPECT_NEAR(inner_energy(g, zigzag_turns(g, kDome, -height)), 2.0 / 3.0, 1e-4);
      EXPECT_NEAR(inner_energy(g, zigzag_turns(g, kSaddle, 0.0)), 4.0 / 3.0, 1e-4);
    }
  }
}

TEST(HingeStiffnessProperty, UnevenMeshesRestWithinATwentiethOfThePlatesEnergyAtAnyCylinder) {
  constexpr std::uint32_t n = 21;
  const GridShape one_way{.rows = n, .columns = n, .width = n - 1, .depth = n - 1};
  GridShape alternate = one_way;
  alternate.alternate = true;
  for (const Mesh& mesh : {uneven(make_grid(one_way), 0.15f), uneven(make_grid(alternate), 0.15f),
                           with_diagonals_by_chance(uneven(make_grid(one_way), 0.1f))}) {
    const Garment g = garment_of(mesh);
    for (const Curvature& k : {kAlong, kAcross, kDiagonal, kOtherDiagonal}) {
      EXPECT_NEAR(inner_energy(g, relaxed_turns(g, k)), 0.5, 0.025) << k.xx << ' ' << k.zz << ' ' << k.xz;
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
