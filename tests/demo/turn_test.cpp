#include "demo/motion/turn.h"

#include <gtest/gtest.h>

namespace pleat::demo {
namespace {

template <class Scalar>
void expect_shortest_turns(Scalar tolerance) {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const Vector y = Vector::UnitY();
  const Vector ways[] = {{0, 2, 0},
                         {3, 0, 0},
                         {0, 0, Scalar(-0.5)},
                         {1, -2, 3},
                         {Scalar(1e-3), 1, 0},
                         {0, -1, Scalar(1e-2)},
                         {Scalar(1e-7), -1, 0},
                         {0, -4, 0}};
  for (const Vector& way : ways) {
    const Vector direction = way.normalized();
    const Eigen::Quaternion<Scalar> turn = turn_from_y(way);
    EXPECT_NEAR(turn.norm(), Scalar(1), tolerance) << way.transpose();
    EXPECT_LT((turn * y - direction).norm(), tolerance) << way.transpose();
    EXPECT_NEAR(turn.vec().dot(y), Scalar(0), tolerance) << "no turn about y: the shortest";
  }
}

TEST(TurnFromY, IsTheShortestToEveryDirection) {
  expect_shortest_turns(1e-4f);
  expect_shortest_turns(1e-6);
}

}  // namespace
}  // namespace pleat::demo
