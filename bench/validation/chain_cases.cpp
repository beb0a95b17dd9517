// Cases of a chain. Its cloth is a ladder, two particles wide, of equal weights: no rung and no diagonal carries load,
// and both of its sides are the same chain.
#include <cmath>
#include <numbers>

#include "bench/validation/chain.h"
#include "bench/validation/check.h"
#include "bench/validation/line_fit.h"
#include "bench/validation/rig.h"

namespace pleat::bench {
namespace {

constexpr float kLightest = 1e-6f;  // kg/m2: the weight is in the nodes
constexpr double kRung = 2.0;       // m; wide, so that a ladder that is stretched leans by little

/// A ladder of `links` cells down the y axis from the origin, 1 m long, rungs along z, in the yz plane. Diagonals
/// alternate, so that a stretched ladder need not lean.
demo::TriangleMesh ladder(int links) {
  demo::TriangleMesh mesh;
  for (int i = 0; i <= links; ++i) {
    const float y = float(-double(i) / links);
    mesh.positions.insert(mesh.positions.end(), {0.0f, y, float(-kRung / 2), 0.0f, y, float(kRung / 2)});
  }
  for (uint32_t i = 0; i < uint32_t(links); ++i) {
    const uint32_t a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    if (i % 2 == 0) {
      mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
    } else {
      mesh.triangles.insert(mesh.triangles.end(), {a, c, d, a, d, b});
    }
  }
  return mesh;
}

/// One side of the ladder, 5 kg in all, half of a node's weight at its end; its links give way by `strain` under all
/// of it.
Chain side(int links, double strain) {
  constexpr double kMass = 5.0;
  Chain chain{.link = 1.0 / links, .stiffness = kMass * kGravity * links / strain};
  chain.node.assign(size_t(links), kMass / links);
  chain.node.back() *= 0.5;
  return chain;
}

RigDef rig_of(const pleat_api& api, const Chain& chain) {
  RigDef def;
  const int links = int(chain.node.size());
  def.mesh = ladder(links);
  def.pins = {0, 1};
  def.added_mass = {0.0f, 0.0f};
  for (const double mass : chain.node) def.added_mass.insert(def.added_mass.end(), 2, float(mass));
  def.settings = bare_settings(api);
  def.settings.density = kLightest;
  def.settings.stiffness = float(chain.stiffness);
  return def;
}

/// Two thirds of the longest step that the stiffest vibration of a chain of such nodes bears.
double step_for(const Chain& chain) { return std::sqrt(0.4 * chain.node.front() / chain.stiffness) * 0.8; }

/// Period of a ladder let go, at rest, in the shape of its chain's mode: ten of them.
double measured_period(const pleat_api& api, const Chain& chain, const Swing& swing) {
  constexpr double kAngle = 0.02;  // rad, of the steepest link: the period is longer by 3e-5 at most
  RigDef def = rig_of(api, chain);
  def.start = def.mesh.positions;
  const std::vector<double> lengths = hanging_lengths(chain);
  double steepest = 0.0, above = 0.0, y = 0.0;
  for (size_t i = 0; i < lengths.size(); ++i) {
    steepest = std::max(steepest, std::abs(swing.shape[i] - above) / lengths[i]);
    above = swing.shape[i];
  }
  for (size_t i = 0; i < lengths.size(); ++i) {
    y -= lengths[i];
    for (size_t k = 0; k < 2; ++k) {
      def.start[6 * (i + 1) + 3 * k] = float(kAngle / steepest * swing.shape[i]);
      def.start[6 * (i + 1) + 3 * k + 1] = float(y);
    }
  }
  Rig rig(api, def);
  const double dt = double(float(step_for(chain)));
  double before = 1.0, first = 0.0;
  for (int i = 1, rises = 0;; ++i) {
    rig.step(dt);
    double now = 0.0;  // the mode's share in the motion
    for (uint32_t n = 0; n < uint32_t(lengths.size()); ++n) {
      now += chain.node[n] * swing.shape[n] * rig.position(2 * (n + 1))[0];
    }
    if (before < 0.0 && now >= 0.0) {
      const double time = dt * (i - now / (now - before));
      if (rises == 0) first = time;
      if (rises++ == 10) return (time - first) / 10.0;
    }
    before = now;
  }
}

/// Depth of a ladder between two points, once it is at rest.
double measured_sag(const pleat_api& api, const Chain& chain, double span) {
  RigDef def = rig_of(api, chain);
  const uint32_t links = uint32_t(chain.node.size());
  def.pins = {0, 1, 2 * links, 2 * links + 1};
  def.start = def.mesh.positions;
  for (uint32_t i = 0; i <= links; ++i) {
    for (uint32_t k = 0; k < 2; ++k) {
      const double u = double(i) / links;
      def.start[6 * i + 3 * k] = float(span * (u - 0.5));
      def.start[6 * i + 3 * k + 1] = float(-1.2 * std::sqrt(1.0 - span) * u * (1.0 - u));
    }
  }
  def.settings.air_damping = 12.0f;
  Rig rig(api, def);
  const double dt = step_for(chain);
  rig.step(dt, int(6.0 / dt));
  double lowest = 0.0;
  for (uint32_t i = 0; i < rig.count(); ++i) lowest = std::min(lowest, rig.position(i)[1]);
  return -lowest;
}

/// Elongation by its own weight of a tube of equilateral triangles, 1 m long: a sheet without a side border.
double tube_elongation(const pleat_api& api, double density, double stiffness) {
  constexpr uint32_t kAround = 24, kRows = 23;
  RigDef def;
  const double sector = 2.0 * std::numbers::pi / kAround, height = 1.0 / (kRows - 1);
  // Slanted edges as long as the level ones: (2 R sin(s/2))^2 = (2 R sin(s/4))^2 + height^2.
  const double across = 2.0 * std::sin(sector / 2), half = 2.0 * std::sin(sector / 4);
  const double radius = height / std::sqrt(across * across - half * half);
  for (uint32_t row = 0; row < kRows; ++row) {
    for (uint32_t k = 0; k < kAround; ++k) {
      const double angle = sector * (k + 0.5 * (row % 2));
      def.mesh.positions.insert(def.mesh.positions.end(), {float(radius * std::cos(angle)), float(-height * row),
                                                           float(radius * std::sin(angle))});
      if (row == 0) def.pins.push_back(k);
      if (row == 0) continue;
      // The two rows below and above, and the particle of each that lies between k and the next one of the other.
      const uint32_t next = (k + 1) % kAround, low = kAround * row, high = low - kAround;
      const uint32_t ahead = row % 2 == 1 ? k : next, above = row % 2 == 1 ? next : k;
      def.mesh.triangles.insert(def.mesh.triangles.end(), {high + k, high + next, low + ahead});
      def.mesh.triangles.insert(def.mesh.triangles.end(), {low + next, low + k, high + above});
    }
  }
  def.settings = bare_settings(api);
  def.settings.density = float(density);
  def.settings.stiffness = float(stiffness);
  def.settings.air_damping = 40.0f;
  Rig rig(api, def);
  rig.step(5e-4, 4000);
  double lowest = 0.0;
  for (uint32_t k = 0; k < kAround; ++k) lowest += rig.position((kRows - 1) * kAround + k)[1] / kAround;
  return -1.0 - lowest;
}

}  // namespace

Checks chain_swing(const pleat_api& api) {
  constexpr double kStrain = 1e-4, kThread[] = {1.66837, 0.72683, 0.46363};
  Checks checks;
  for (int mode = 1; mode <= 3; ++mode) {
    const std::string name = "mode " + std::to_string(mode) + ", ";
    double coarse = 0.0, fine = 0.0;
    for (const int links : {10, 20, 40}) {
      const Chain chain = side(links, kStrain);
      const Swing swing = hanging_swing(chain, mode);
      coarse = fine, fine = measured_period(api, chain, swing);
      checks.push_back(relative(name + std::to_string(links) + " links, discrete, s", swing.period, fine, 1e-4));
    }
    // The chain's error falls with the square of its links' length.
    checks.push_back(
        relative(name + "extrapolated to a thread, s", kThread[mode - 1], fine + (fine - coarse) / 3, 1e-3));
  }
  return checks;
}

Checks catenary(const pleat_api& api) {
  constexpr double kStrain = 1e-4;
  Checks checks;
  for (const auto& [span, thread] : {std::pair{0.99, 0.061145}, std::pair{0.95, 0.135898}, std::pair{0.9, 0.190709},
                                     std::pair{0.8, 0.265438}, std::pair{0.7, 0.319720}, std::pair{0.5, 0.398194}}) {
    const Chain chain = side(20, kStrain);
    const double measured = measured_sag(api, chain, span);
    const std::string name = "span " + std::to_string(span).substr(0, 4);
    checks.push_back(absolute(name + ", 20 links, discrete, m", sag(chain, span), measured, 1e-4));
    // Of the shallowest one's depth the springs' stretch of 1e-4 alone is a hundredth.
    if (span < 0.99) checks.push_back(relative(name + ", thread, m", thread, measured, 1e-2));
  }
  std::vector<double> x, y;
  const double thread = sag(side(2000, kStrain), 0.8);
  for (const int links : {6, 10, 20}) {
    x.push_back(std::log(1.0 / links));
    y.push_back(std::log(std::abs(measured_sag(api, side(links, kStrain), 0.8) - thread)));
  }
  checks.push_back(absolute("span 0.80, order in the links' length", 2.0, fit_line(x, y).slope, 0.1));
  return checks;
}

Checks own_weight(const pleat_api& api) {
  Checks checks;
  const Chain chain = side(20, 0.1);
  RigDef def = rig_of(api, chain);
  def.settings.air_damping = 12.0f;
  Rig rig(api, def);
  const double dt = 0.8 * step_for(chain);  // with this damping the longer one would be borne by softer springs
  rig.step(dt, int(8.0 / dt));
  double expected = -1.0;
  for (const double l : hanging_lengths(chain)) expected += l;
  checks.push_back(relative("chain, eq (1), elongation, m", expected, -rig.position(40)[1] - 1.0, 1e-4));
  // Triangles of springs k are a sheet of modulus 2 k / sqrt(3), N/m, in every direction.
  constexpr double kDensity = 0.2, kStiffness = 400.0, kModulus = 2.0 * kStiffness / std::numbers::sqrt3;
  checks.push_back(relative("tube, modulus 2k/sqrt(3), elongation, m", kDensity * kGravity / (2.0 * kModulus),
                            tube_elongation(api, kDensity, kStiffness), 2e-2));
  return checks;
}

}  // namespace pleat::bench
