#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "demo/motion/clip.h"

namespace pleat::demo {

/// Where all joints of a skeleton are: world space, metres, y up.
struct Pose {
  std::vector<Eigen::Vector3d> position;     ///< (joints)
  std::vector<Eigen::Quaterniond> rotation;  ///< (joints), from the joint's frame to the world's
};

/// All rotations zero, all joints at their offsets.
Pose rest_pose(const Skeleton& skeleton);

/// A part of the way from the rest pose, its root already where the first frame has it, to the first frame.
/// share: 0 at rest .. 1 in the first frame.
Pose pose_to_first_frame(const Clip& clip, double share);

/// As recorded; frame < clip.frame_count().
Pose pose_at_frame(const Clip& clip, std::size_t frame);

/// Between two frames positions go straight and rotations take the shortest arc. The clip's ends hold before and after.
Pose pose_at(const Clip& clip, double seconds);

}  // namespace pleat::demo
