// The references that `validate` judges by, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/validation/chain.h"
#include "bench/validation/check.h"
#include "bench/validation/elastica.h"
#include "bench/validation/spring_net.h"

namespace pleat::bench {
namespace {

Chain thread(int links, double stiffness = 1e9) {
  Chain chain{.link = 1.0 / links, .stiffness = stiffness * links};
  chain.node.assign(size_t(links), 1.0 / links);
  chain.node.back() *= 0.5;
  return chain;
}

TEST(ValidationReference, HangingChainSwingsAsBesselSays) {
  constexpr double kZeros[] = {2.404825557695773, 5.520078110286311, 8.653727912911013};
  for (int mode = 1; mode <= 3; ++mode) {
    const double expected = 4.0 * std::numbers::pi / (kZeros[mode - 1] * std::sqrt(kGravity / 1.0));
    EXPECT_NEAR(hanging_swing(thread(1000), mode).period, expected, 2e-5 * expected);
  }
  EXPECT_NEAR(hanging_swing(thread(5), 1).period, 1.68805, 1e-5);
  EXPECT_NEAR(hanging_swing(thread(20), 1).period, 1.66960, 1e-5);
}

TEST(ValidationReference, ChainBetweenTwoPointsIsACatenary) {
  EXPECT_NEAR(sag(thread(1000), 0.8), 0.265438, 2e-6);
  EXPECT_NEAR(sag(thread(1000), 0.5), 0.398194, 2e-6);
  EXPECT_NEAR(sag(thread(10), 0.8), 0.266864, 2e-6);
}

TEST(ValidationReference, StretchedLinkBalancesEquationOne) {
  const Chain chain{.link = 0.1, .stiffness = 30.0};
  const double l = stretched(chain, 2.0);
  EXPECT_NEAR(30.0 * (l / 0.1 - 1.0) * l, 2.0, 1e-12);
}

TEST(ValidationReference, ElasticaHasItsLimits) {
  EXPECT_NEAR(elastica_droop(0.01, 2000), 0.01 / 8, 1e-6);
  EXPECT_NEAR(elastica_droop(8.0, 2000), 0.8843, 1e-4);
  EXPECT_NEAR(elastica_droop(50.0, 4000), 3.7056, 1e-3);
}

TEST(ValidationReference, SpringNetKeepsEnergyAndMomentum) {
  demo::TriangleMesh mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.triangles = {0, 1, 2};
  SpringNet net = net_of_triangle(mesh, {}, 0.2, 100.0);
  net.position[1][0] = 1.2;
  const double before = net.energy();
  EXPECT_NEAR(before,
              100.0 * (1.2 * 1.2 * 1.2 / 3 - 1.2 * 1.2 / 2 + 1.0 / 6) +
                  100.0 * (std::pow(1.2 * 1.2 + 1, 1.5) / (3 * std::sqrt(2)) - (1.2 * 1.2 + 1) / 2 + 2.0 / 6),
              1e-12);
  for (int i = 0; i < 1000; ++i) net.step(1e-4, PLEAT_INTEGRATOR_RUNGE_KUTTA_4);
  EXPECT_NEAR(net.energy(), before, 1e-10 * before);
  double momentum = 0.0;
  for (size_t i = 0; i < 3; ++i) momentum += net.mass[i] * net.velocity[i][0];
  EXPECT_NEAR(momentum, 0.0, 1e-12);
}

TEST(ValidationCheck, AFigureThatIsNoNumberFails) {
  EXPECT_TRUE(relative("", 2.0, 2.02, 0.011).pass());
  EXPECT_FALSE(relative("", 2.0, 2.03, 0.011).pass());
  EXPECT_FALSE(absolute("", 0.0, std::nan(""), 1.0).pass());
}

}  // namespace
}  // namespace pleat::bench
