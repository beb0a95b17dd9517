#include "bench/validation/spring_net.h"

#include <cmath>

namespace pleat::bench {
namespace {

Point plus(const Point& a, const Point& b, double scale) {
  return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}
double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }

std::vector<Point> plus(std::vector<Point> a, const std::vector<Point>& b, double scale) {
  for (size_t i = 0; i < a.size(); ++i) a[i] = plus(a[i], b[i], scale);
  return a;
}

}  // namespace

std::vector<Point> SpringNet::acceleration(const std::vector<Point>& x) const {
  std::vector<Point> a(x.size(), Point{0.0, -gravity, 0.0});
  for (const Spring& spring : springs) {
    const Point d = plus(x[spring.j], x[spring.i], -1.0);
    const double pull = stiffness * (length(d) / spring.length - 1.0);
    if (mass[spring.i] > 0.0) a[spring.i] = plus(a[spring.i], d, pull / mass[spring.i]);
    if (mass[spring.j] > 0.0) a[spring.j] = plus(a[spring.j], d, -pull / mass[spring.j]);
  }
  for (size_t i = 0; i < x.size(); ++i) {
    if (mass[i] == 0.0) a[i] = {};
  }
  return a;
}

void SpringNet::step(double dt, uint32_t integrator) {
  if (integrator != PLEAT_INTEGRATOR_RUNGE_KUTTA_4) {
    const std::vector<Point> old = velocity;
    velocity = plus(velocity, acceleration(position), dt);
    position = plus(position, integrator == PLEAT_INTEGRATOR_EXPLICIT_EULER ? old : velocity, dt);
    return;
  }
  const std::vector<Point> v1 = velocity, a1 = acceleration(position);
  const std::vector<Point> v2 = plus(velocity, a1, dt / 2), a2 = acceleration(plus(position, v1, dt / 2));
  const std::vector<Point> v3 = plus(velocity, a2, dt / 2), a3 = acceleration(plus(position, v2, dt / 2));
  const std::vector<Point> v4 = plus(velocity, a3, dt), a4 = acceleration(plus(position, v3, dt));
  position = plus(plus(plus(plus(position, v1, dt / 6), v2, dt / 3), v3, dt / 3), v4, dt / 6);
  velocity = plus(plus(plus(plus(velocity, a1, dt / 6), a2, dt / 3), a3, dt / 3), a4, dt / 6);
}

double SpringNet::energy() const {
  double sum = 0.0;
  for (size_t i = 0; i < position.size(); ++i) {
    const double speed = length(velocity[i]);
    sum += mass[i] * (0.5 * speed * speed + gravity * position[i][1]);
  }
  for (const Spring& spring : springs) {
    const double l = length(plus(position[spring.j], position[spring.i], -1.0)), rest = spring.length;
    sum += stiffness * (l * l * l / (3.0 * rest) - l * l / 2.0 + rest * rest / 6.0);
  }
  return sum;
}

SpringNet net_of_triangle(const demo::TriangleMesh& mesh, const std::vector<uint32_t>& pins, double density,
                          double stiffness) {
  SpringNet net;
  for (size_t i = 0; i < 3; ++i) {
    net.position.push_back({mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2]});
  }
  const auto side = [&](size_t i, size_t j) { return length(plus(net.position[j], net.position[i], -1.0)); };
  net.springs = {{0, 1, side(0, 1)}, {1, 2, side(1, 2)}, {0, 2, side(0, 2)}};
  const double a = side(0, 1), b = side(1, 2), c = side(0, 2), s = (a + b + c) / 2;
  net.velocity.assign(3, Point{});
  net.mass.assign(3, density * std::sqrt(s * (s - a) * (s - b) * (s - c)) / 3);
  for (const uint32_t pin : pins) net.mass[pin] = 0.0;
  net.stiffness = stiffness;
  return net;
}

}  // namespace pleat::bench
