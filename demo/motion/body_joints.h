#pragma once

#include <array>

#include "demo/motion/clip.h"

namespace pleat::demo {

enum Side { kLeft, kRight };
inline constexpr std::array<Side, 2> kSides = {kLeft, kRight};

inline constexpr int kNoJoint = -1;

/// An arm or a leg: the joints at its root, its middle and its end. All or none are there.
struct Limb {
  int upper = kNoJoint;
  int lower = kNoJoint;
  int end = kNoJoint;
};

/// Which joints of a skeleton are which parts of a human body, as indices into its joints.
struct BodyJoints {
  int hips = kNoJoint;  ///< carries both legs
  int neck = kNoJoint;  ///< may be missing, as may all below
  int head = kNoJoint;
  std::array<Limb, 2> legs;  ///< never missing
  std::array<int, 2> toes = {kNoJoint, kNoJoint};
  std::array<Limb, 2> arms;
};

/// Finds a body's joints by the names that are in use (`Character1_LeftUpLeg`, `mixamorig:LeftUpLeg`, `lThigh`,
/// `LeftHip`, `thigh_l`). Of several joints of one name the first wins, and a limb's joints must descend from each
/// other, so that helper joints do not get in the way.
/// Throws InputError, listing the joints that are there, when a leg is missing.
BodyJoints find_body_joints(const Clip& clip);

}  // namespace pleat::demo
