#include "demo/motion/pose.h"

#include <algorithm>
#include <numbers>

namespace pleat::demo {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// A joint in its parent's frame.
struct LocalPose {
  Eigen::Vector3d position;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

LocalPose local_pose(const Joint& joint, const double* frame) {
  LocalPose local{joint.offset};
  const double* value = frame + joint.first_column;
  for (const Channel channel : joint.channels) {
    const int column = static_cast<int>(channel);
    if (column < 3) {
      local.position[column] = *value++;
    } else {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(column - 3);
      local.rotation = local.rotation * Eigen::AngleAxisd(*value++ * kRadiansPerDegree, axis);
    }
  }
  return local;
}

/// Forward kinematics: places joints from the root outwards; `local` gives a joint in its parent's frame.
template <typename Local>
Pose place_joints(const Skeleton& skeleton, Local local) {
  Pose pose;
  pose.position.reserve(skeleton.joints.size());
  pose.rotation.reserve(skeleton.joints.size());
  for (const Joint& joint : skeleton.joints) {
    const LocalPose own = local(joint);
    const Eigen::Vector3d offset = own.position * kMetresPerUnit;
    if (joint.parent < 0) {
      pose.position.push_back(offset);
      pose.rotation.push_back(own.rotation);
    } else {
      const auto parent = static_cast<std::size_t>(joint.parent);
      pose.position.push_back(pose.position[parent] + pose.rotation[parent] * offset);
      pose.rotation.push_back((pose.rotation[parent] * own.rotation).normalized());
    }
  }
  return pose;
}

}  // namespace

Pose rest_pose(const Skeleton& skeleton) {
  return place_joints(skeleton, [](const Joint& joint) { return LocalPose{joint.offset}; });
}

Pose pose_to_first_frame(const Clip& clip, double share) {
  return place_joints(clip.skeleton, [&](const Joint& joint) {
    const LocalPose first = local_pose(joint, clip.frames.data());
    if (joint.parent < 0) return first;
    const LocalPose rest{joint.offset};
    return LocalPose{rest.position + share * (first.position - rest.position),
                     rest.rotation.slerp(share, first.rotation)};
  });
}

Pose pose_at_frame(const Clip& clip, std::size_t frame) {
  const double* row = clip.frames.data() + frame * clip.skeleton.channel_count;
  return place_joints(clip.skeleton, [row](const Joint& joint) { return local_pose(joint, row); });
}

Pose pose_at(const Clip& clip, double seconds) {
  const std::size_t last = clip.frame_count() - 1;
  const double at = std::min(std::max(0.0, seconds / clip.frame_time), static_cast<double>(last));
  const auto before = static_cast<std::size_t>(at);
  const std::size_t after = std::min(before + 1, last);
  const double blend = at - static_cast<double>(before);
  const double* row = clip.frames.data() + before * clip.skeleton.channel_count;
  const double* next_row = clip.frames.data() + after * clip.skeleton.channel_count;
  return place_joints(clip.skeleton, [=](const Joint& joint) {
    const LocalPose a = local_pose(joint, row);
    const LocalPose b = local_pose(joint, next_row);
    return LocalPose{a.position + blend * (b.position - a.position), a.rotation.slerp(blend, b.rotation)};
  });
}

}  // namespace pleat::demo
