#pragma once

#include <Eigen/Geometry>

namespace pleat::demo {

/// The shortest turn that takes y to the direction of `to`, which is not zero: about x where that is -y. As Eigen's
/// FromTwoVectors, but for its singular value decomposition, which takes longer to compile than most of our files.
template <class Scalar>
Eigen::Quaternion<Scalar> turn_from_y(const Eigen::Matrix<Scalar, 3, 1>& to) {
  const Eigen::Matrix<Scalar, 3, 1> direction = to.normalized();
  const Scalar cosine = direction.y();
  if (cosine < Scalar(-1) + Eigen::NumTraits<Scalar>::dummy_precision()) return {0, 1, 0, 0};  // w first
  return Eigen::Quaternion<Scalar>(Scalar(1) + cosine, direction.z(), 0, -direction.x()).normalized();
}

}  // namespace pleat::demo
