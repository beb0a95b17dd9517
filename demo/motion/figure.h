#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "demo/motion/clip.h"
#include "demo/motion/pose.h"

namespace pleat::demo {

/// All points within `radius` of the segment ab; a tapered one is the hull of its end balls. World space, metres.
struct CapsulePose {
  Eigen::Vector3f a, b;
  float radius;
  float taper = 0.0f;  ///< what the ball about b has more, less than the length of ab
};

/// A point that moves with a joint, in the joint's frame, m.
struct Anchor {
  int joint = 0;
  Eigen::Vector3d local = Eigen::Vector3d::Zero();
};

struct BodyCapsule {
  Anchor a, b;
  double radius;
};

/// A human body of capsules that follows a skeleton.
///
/// Its hips frame has the origin midway between the hip joints, x to the body's left, y up along the body and z
/// forward, so that a garment modelled round the y axis of a standing body can be put on by one transform.
///
/// The waist is the circle of `waist_radius` about (0, waist_height, 0) in that frame; pelvis and torso lie inside it
/// at that height. A ring of n straight edges clears them by d when its corners are (waist_radius + d) / cos(pi/n)
/// away.
struct Figure {
  std::vector<BodyCapsule> capsules;     ///< the first is the pelvis, the arms come last
  std::size_t first_arm = 0;             ///< where the arms begin; as many as there are capsules if there are none
  std::array<std::size_t, 2> feet = {};  ///< which capsules stand on the ground
  Anchor hips;                           ///< origin of the hips frame
  Eigen::Matrix3d hips_axes;             ///< columns x, y, z in the frame of the joint of `hips`
  double leg_length = 0;                 ///< hip joint to ankle, mean of both, m
  double waist_height = 0;               ///< above the hip joints, m
  double waist_radius = 0;               ///< m
};

/// Fits a body to a skeleton at rest: positions from the joints, thickness in proportion to the legs.
/// Legs and hips must be there; a missing arm, neck or head is left out. End sites and joints that are no part of a
/// body are not used, but for an end site near the foot, which is its tip.
///
/// Throws InputError when a leg is missing or its length is not that of a human, 0.2 to 2 m.
Figure fit_figure(const Clip& clip);

/// The capsules, in the figure's order.
std::vector<CapsulePose> capsules_at(const Figure& figure, const Pose& pose);

/// From the hips frame to the world.
Eigen::Isometry3d hips_at(const Figure& figure, const Pose& pose);

/// Height of the lowest point that a foot reaches in the whole clip: where the ground is, m.
double ground_height(const Figure& figure, const Clip& clip);

/// How many frames at the start lead from another pose: recordings often begin with a calibration pose and reach the
/// motion within a few frames. Counts up to the last of the first ten in which a limb is faster, against the hips, than
/// a human's.
std::size_t calibration_frames(const Figure& figure, const Clip& clip);

}  // namespace pleat::demo
