#include "components/geodesics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "components/neighbours.h"

namespace pleat {
namespace {

constexpr double kSameSource = 0.01;  // of an edge: how well three particles must agree on where a way comes from
constexpr float kShorter = 0.9999f;   // a way that is hardly shorter is not worth going on from
constexpr double kThroughEnd = 1e-4;  // of an edge: a way through one of its ends passes despite rounding

/// A point of a plane in which an edge lies along x, from the origin.
struct Flat {
  double x, y;
};
double apart(const Flat& a, const Flat& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The point at distances `a` and `b` from the ends of the edge, on the side y >= 0; nothing is there if y is NaN.
Flat above(double edge, double a, double b) {
  const double x = (a * a - b * b + edge * edge) / (2.0 * edge);
  return {x, std::sqrt(a * a - x * x)};
}

class Search {
 public:
  explicit Search(const Garment& g)
      : g_(g),
        edges_(g.particle_count, g.edge_particle),
        hinges_(g.particle_count, g.hinge_particle),
        known_(g.particle_count) {
    constexpr Way kUnknown{std::numeric_limits<float>::infinity(), kNone, kNone};
    for (auto& known : known_) known.fill(kUnknown);
  }

  std::vector<Way> run() {
    for (const std::uint32_t pin : g_.pins) arrivals_.emplace(0.0f, pin, pin);
    while (!arrivals_.empty()) {
      const auto [length, i, pin] = arrivals_.top();
      arrivals_.pop();
      if ((g_.pinned[i] == 0 || i == pin) && improve({length, i, pin})) go_on(length, i, pin);
    }
    std::vector<Way> ways;
    for (const auto& known : known_) {
      for (const Way& way : known) {
        if (way.pin != kNone && way.pin != way.particle) ways.push_back(way);
      }
    }
    std::ranges::sort(ways, {}, [](const Way& way) { return std::tuple(way.length, way.particle, way.pin); });
    return ways;
  }

 private:
  using Arrival = std::tuple<float, std::uint32_t, std::uint32_t>;  // length of the way, particle, pin

  /// False where the particle knows a way that is as short, or enough to nearer pins. A straight way across faces may
  /// come after a longer one along edges, when what lies behind these faces is known at last.
  bool improve(const Way& way) {
    auto& known = known_[way.particle];
    auto place = std::ranges::find(known, way.pin, &Way::pin);
    if (place == known.end()) place = std::ranges::max_element(known, {}, &Way::length);
    if (!(way.length < kShorter * place->length)) return false;
    *place = way;
    return true;
  }

  /// NaN as long as the way is not known.
  double way_from(std::uint32_t particle, std::uint32_t pin) const {
    for (const Way& known : known_[particle]) {
      if (known.pin == pin) return static_cast<double>(known.length);
    }
    return std::nan("");
  }

  void go_on(float length, std::uint32_t i, std::uint32_t pin) {
    for (const std::uint32_t e : edges_.of(i))
      arrivals_.emplace(length + g_.edge_rest_length[e], across(g_, e, i), pin);
    for (const std::uint32_t h : hinges_.of(i)) {
      cross(h, 2, 3, pin);
      cross(h, 3, 2, pin);
    }
  }

  /// From the tip `from` of hinge h and its edge straight on to the tip `to`, where all three know ways that come from
  /// one point of the plane: beyond a cut, where ways around both of its sides meet, they do not.
  void cross(std::uint32_t h, std::size_t from, std::size_t to, std::uint32_t pin) {
    const auto particle = [&](std::size_t k) { return g_.hinge_particle[k][h]; };
    const double a = way_from(particle(0), pin), b = way_from(particle(1), pin), c = way_from(particle(from), pin);
    if (std::isnan(a + b + c)) return;
    const auto rest = [&](std::size_t k, std::size_t l) {
      const ConstVec3View x = g_.rest_position.view();
      return static_cast<double>(length(x[particle(k)] - x[particle(l)]));
    };
    const double edge = rest(0, 1);
    const Flat source = above(edge, a, b), behind = above(edge, rest(0, from), rest(1, from));
    if (!(std::abs(apart(source, behind) - c) <= kSameSource * edge)) return;
    const Flat tip = above(edge, rest(0, to), rest(1, to));
    const double crossing = source.x + (tip.x - source.x) * source.y / (source.y + tip.y);
    if (!(crossing >= -kThroughEnd * edge && crossing <= (1.0 + kThroughEnd) * edge)) return;
    const double way = std::hypot(tip.x - source.x, tip.y + source.y);
    arrivals_.emplace(static_cast<float>(way), particle(to), pin);
  }

  const Garment& g_;
  IndexLists edges_, hinges_;
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> arrivals_;
  std::vector<std::array<Way, kPinsPerParticle>> known_;
};

}  // namespace

std::vector<Way> ways_to_pins(const Garment& garment) { return Search(garment).run(); }

}  // namespace pleat
