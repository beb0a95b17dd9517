#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "demo/motion/clip.h"
#include "demo/motion/figure.h"
#include "demo/motion/point_cache.h"

namespace pleat::demo {

/// Where a body is at one moment.
struct BodyPose {
  Eigen::Isometry3d hips = Eigen::Isometry3d::Identity();  ///< from the hips frame to the world; pins follow it
  std::vector<CapsulePose> capsules;                       ///< always as many, in the same order
  std::size_t touching = 0;                                ///< the first so many are colliders, the others only shown
  std::vector<float> vertices;                             ///< (V,3) m, of a mesh body; empty where there is none
};

/// A body's pose as a function of time in seconds; before 0 it gets ready.
using BodyMotion = std::function<BodyPose(double seconds)>;

/// The analytic kick of workload W1, one kick a second: pelvis and two legs, seven capsules. At the height of the kick
/// the thigh stands `thigh` degrees forward of vertical and the shin `knee` degrees behind the thigh. The hips frame
/// at 0 s is the world's.
BodyMotion make_kick(double thigh, double knee);

/// A recorded clip on a figure fitted to it. A skirt is cut for the figure at rest, and a leg that strides in the first
/// frame would begin outside of it; so the figure stands at rest until 1 s before frame 0, steps into that frame in
/// half a second and holds it. After the last frame it holds still. The arms are only shown: recorded hands swing
/// through the hips of a fitted figure and would nail a skirt to them.
BodyMotion make_clip_motion(Clip clip, Figure figure);

/// A mesh body that goes through `cache`, `rate` samples a second; before the first sample it stands as in that one,
/// after the last as in the last. Its hips move as the vertices `hips` do on the whole: the rigid motion that fits them
/// best (S. Umeyama, 1991). At 0 s the hips frame is the world's.
BodyMotion make_sequence_motion(PointCache cache, double rate, std::vector<uint32_t> hips);

}  // namespace pleat::demo
