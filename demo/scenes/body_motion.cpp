#include "demo/scenes/body_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "demo/motion/pose.h"

namespace pleat::demo {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kStepIn = 1.0;  // s
constexpr double kDegree = std::numbers::pi / 180.0;

CapsulePose capsule(const Eigen::Isometry3d& hips, const Vector3d& a, const Vector3d& b, double radius) {
  return {(hips * a).cast<float>(), (hips * b).cast<float>(), float(radius)};
}

/// Thigh, shin and foot of a leg whose thigh stands at angle a and whose shin at angle b from vertical, rad.
void add_leg(BodyPose& pose, double x, double a, double b) {
  const Vector3d hip(x, 0.90, 0.0);
  const Vector3d knee = hip + 0.42 * Vector3d(0.0, -std::cos(a), std::sin(a));
  const Vector3d ankle = knee + 0.42 * Vector3d(0.0, -std::cos(b), std::sin(b));
  const Vector3d toe = ankle + 0.15 * Vector3d(0.0, std::sin(b), std::cos(b));
  pose.capsules.push_back(capsule(pose.hips, hip, knee, 0.075));
  pose.capsules.push_back(capsule(pose.hips, knee, ankle, 0.055));
  pose.capsules.push_back(capsule(pose.hips, ankle, toe, 0.045));
}

/// How far a figure has stepped from its rest pose into the first frame, which it reaches half of the time before it.
double step_in(double seconds) {
  const double t = std::clamp(2.0 * (1.0 + seconds / kStepIn), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

BodyMotion make_kick(double thigh, double knee) {
  return [thigh, knee](double seconds) {
    const double phase = 2.0 * std::numbers::pi * seconds;
    const double raise = 0.5 * (1.0 - std::cos(phase));
    const double a = thigh * kDegree * raise, b = a - knee * kDegree * raise;
    BodyPose pose;
    pose.hips.translate(Vector3d(0.04 * std::sin(phase), 0.02 * std::sin(2.0 * phase), 0.0));
    pose.hips.rotate(AngleAxisd(10.0 * kDegree * std::sin(phase), Vector3d::UnitY()));
    pose.capsules.push_back(capsule(pose.hips, {-0.05, 0.95, 0.0}, {0.05, 0.95, 0.0}, 0.11));
    add_leg(pose, -0.09, a, b);
    add_leg(pose, 0.09, 0.0, 0.0);
    pose.touching = pose.capsules.size();
    return pose;
  };
}

BodyMotion make_clip_motion(Clip clip, Figure figure) {
  return [clip = std::move(clip), figure = std::move(figure)](double seconds) {
    const Pose pose = seconds < 0.0 ? pose_to_first_frame(clip, step_in(seconds)) : pose_at(clip, seconds);
    return BodyPose{hips_at(figure, pose), capsules_at(figure, pose), figure.first_arm, {}};
  };
}

BodyMotion make_sequence_motion(PointCache cache, double rate, std::vector<uint32_t> hips) {
  const auto hips_of = [hips = std::move(hips)](const std::vector<float>& vertices) {
    Eigen::Matrix3Xd places(3, Eigen::Index(hips.size()));
    for (size_t i = 0; i < hips.size(); ++i) {
      places.col(Eigen::Index(i)) = Eigen::Map<const Eigen::Vector3f>(vertices.data() + 3 * hips[i]).cast<double>();
    }
    return places;
  };
  const Eigen::Matrix3Xd first = hips_of(cache.at(0.0));
  return [cache = std::move(cache), rate, hips_of, first](double seconds) {
    BodyPose pose;
    pose.vertices = cache.at(seconds * rate);
    pose.hips = Eigen::Isometry3d(Eigen::umeyama(first, hips_of(pose.vertices), false));
    return pose;
  };
}

}  // namespace pleat::demo
