#include "systems/implicit_solver.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pleat {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector3 = Eigen::Vector3d;
using Block = Eigen::Matrix3d;

/// Where the columns of a 3 x 3 block begin among the matrix's values.
using Place = std::array<int, 3>;
constexpr int kPinned = -1;

/// Eigen's LDL^T without its copy of the matrix, which would be a new one for each factor: ours is in order already.
class Factor : public Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> {
 public:
  void refactor(const Matrix& matrix) { factorize_preordered<true>(matrix); }
  /// Solves in place.
  void apply_to(Eigen::VectorXd& b) const {
    matrixL().solveInPlace(b);
    b.array() /= m_diag.array();  // vectorD() is a copy
    matrixU().solveInPlace(b);
  }
};

/// Rows for the free particles in an order that keeps the factor sparse; kPinned for the others.
std::vector<int> order_of(const Garment& g) {
  std::vector<int> row(g.particle_count, kPinned);
  int count = 0;
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (g.pinned[i] == 0) row[i] = count++;
  }
  std::vector<Eigen::Triplet<double>> couples;
  for (int i = 0; i < count; ++i) couples.emplace_back(i, i, 1.0);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const int i = row[g.edge_particle[0][e]], j = row[g.edge_particle[1][e]];
    if (i != kPinned && j != kPinned) couples.emplace_back(i, j, 1.0);
  }
  Matrix graph(count, count);
  graph.setFromTriplets(couples.begin(), couples.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  std::vector<int> place(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) place[static_cast<std::size_t>(order.indices()[k])] = k;
  for (int& r : row) {
    if (r != kPinned) r = place[static_cast<std::size_t>(r)];
  }
  return row;
}

}  // namespace

struct ImplicitMatrix::Parts {
  std::vector<int> row;             // of each particle, in blocks of 3
  std::vector<Place> own, between;  // blocks of free particles by row, and of edges whose ends are both free
  Matrix matrix;                    // its upper triangle
  Eigen::VectorXd change;           // m/s; the right-hand side, then the solution
  Factor factor;
};

ImplicitMatrix::ImplicitMatrix(const Garment& g) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.row = order_of(g);
  const int count = static_cast<int>(g.particle_count - g.pins.size());
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_block = [&](int r, int c) {
    for (int k = 0; k < 3; ++k) {
      for (int l = r == c ? k : 0; l < 3; ++l) entries.emplace_back(3 * r + k, 3 * c + l, 1.0);
    }
  };
  const auto rows_of = [&](std::uint32_t e) {
    return std::minmax(p.row[g.edge_particle[0][e]], p.row[g.edge_particle[1][e]]);
  };
  for (int r = 0; r < count; ++r) add_block(r, r);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const auto [r, c] = rows_of(e);
    if (r != kPinned) add_block(r, c);
  }
  p.matrix.resize(3 * count, 3 * count);
  p.matrix.setFromTriplets(entries.begin(), entries.end());
  p.change.resize(3 * count);
  p.factor.analyzePattern(p.matrix);

  const auto place_of = [&](int r, int c) {
    Place place;
    for (int l = 0; l < 3; ++l) {
      const int* begin = p.matrix.innerIndexPtr() + p.matrix.outerIndexPtr()[3 * c + l];
      const int* end = p.matrix.innerIndexPtr() + p.matrix.outerIndexPtr()[3 * c + l + 1];
      place[static_cast<std::size_t>(l)] =
          static_cast<int>(std::lower_bound(begin, end, 3 * r) - p.matrix.innerIndexPtr());
    }
    return place;
  };
  for (int r = 0; r < count; ++r) p.own.push_back(place_of(r, r));
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const auto [r, c] = rows_of(e);
    p.between.push_back(r != kPinned ? place_of(r, c) : Place{});
  }
}

ImplicitMatrix::~ImplicitMatrix() = default;

bool ImplicitIntegration::validate() const {
  return garment != nullptr && matrix != nullptr && inverse_mass != nullptr && force.x != nullptr &&
         position.x != nullptr && velocity.x != nullptr && law.stiffness >= 0.0f && law.buckling >= 0.0f && dt > 0.0f;
}

void ImplicitIntegration::run() const {
  ImplicitMatrix::Parts& p = *matrix->parts_;
  double* values = p.matrix.valuePtr();
  const auto add = [values](const Place& place, const Block& block, bool whole) {
    for (int l = 0; l < 3; ++l) {
      for (int k = 0; k < (whole ? 3 : l + 1); ++k) values[place[static_cast<std::size_t>(l)] + k] += block(k, l);
    }
  };
  const auto wide = [](const Vec3& v) { return Vector3(v.x, v.y, v.z); };
  const double step = static_cast<double>(dt);

  std::fill_n(values, p.matrix.nonZeros(), 0.0);
  for (std::uint32_t i = 0; i < garment->particle_count; ++i) {
    if (p.row[i] == kPinned) continue;
    // A vertex of no face has no mass; it stays where it is.
    const double mass = inverse_mass[i] > 0.0f ? 1.0 / static_cast<double>(inverse_mass[i]) : 1.0;
    add(p.own[static_cast<std::size_t>(p.row[i])], mass * Block::Identity(), false);
    p.change.segment<3>(3 * p.row[i]) =
        inverse_mass[i] > 0.0f ? Vector3(step * wide(force[i])) : Vector3(0.0, 0.0, 0.0);
  }
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = garment->edge_particle[0][e], j = garment->edge_particle[1][e];
    const Vector3 d = wide(position[j] - position[i]);
    const double l = d.norm(), rest = static_cast<double>(garment->edge_rest_length[e]);
    const Vector3 u = l > 0.0 ? Vector3(d / l) : Vector3(0.0, 0.0, 0.0);
    const EdgeLine line = law.at(static_cast<float>(l / rest));
    const double k = step * step * static_cast<double>(line.stiffness);
    const double tension = std::max(l / rest - static_cast<double>(line.rest), 0.0);
    const Block block = k * (tension * Block::Identity() + l / rest * u * u.transpose());
    const Vector3 pull = block * wide(velocity[j] - velocity[i]);
    const int ri = p.row[i], rj = p.row[j];
    if (ri != kPinned) {
      add(p.own[static_cast<std::size_t>(ri)], block, false);
      p.change.segment<3>(3 * ri) += pull;
    }
    if (rj != kPinned) {
      add(p.own[static_cast<std::size_t>(rj)], block, false);
      p.change.segment<3>(3 * rj) -= pull;
    }
    if (ri != kPinned && rj != kPinned) add(p.between[e], -block, true);
  }
  p.factor.refactor(p.matrix);
  p.factor.apply_to(p.change);

  for (std::uint32_t i = 0; i < garment->particle_count; ++i) {
    if (p.row[i] != kPinned) {
      const Vector3 change = p.change.segment<3>(3 * p.row[i]);
      velocity.add(i, {static_cast<float>(change.x()), static_cast<float>(change.y()), static_cast<float>(change.z())});
    }
    position.add(i, velocity[i] * dt);
  }
}

}  // namespace pleat
