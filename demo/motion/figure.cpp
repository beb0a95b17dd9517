#include "demo/motion/figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "demo/input_error.h"
#include "demo/motion/body_joints.h"

namespace pleat::demo {
namespace {

using Eigen::Vector3d;

/// Sizes of a human of 1.70 m, in metres; other bodies are scaled by the length of the leg.
/// Pelvis, legs and waist are those of the benchmark's analytic skirt scene.
namespace human {
constexpr double kLegLength = 0.84;
constexpr double kPelvisHeight = 0.05;  // above the hip joints
constexpr double kPelvisRadius = 0.11;
constexpr double kPelvisWidth = 0.55;  // between the capsule's ends, as a share of the distance of the hip joints
constexpr double kThighRadius = 0.075;
constexpr double kShinRadius = 0.055;
constexpr double kFootLength = 0.15;  // ankle to tip
constexpr double kFootRadius = 0.045;
constexpr double kWaistHeight = 0.15;  // above the hip joints
constexpr double kTorsoRadius = 0.115;
constexpr double kTorsoBelowNeck = 0.14;
constexpr double kShoulderRadius = 0.06;
constexpr double kNeckRadius = 0.05;
constexpr double kHeadBottom = 0.04, kHeadTop = 0.09;  // of the capsule's core, above the head's joint
constexpr double kHeadRadius = 0.09;
constexpr double kUpperArmRadius = 0.045;
constexpr double kForearmRadius = 0.038;
constexpr double kHandLength = 0.10;
constexpr double kHandRadius = 0.038;
}  // namespace human

std::size_t index(int joint) { return static_cast<std::size_t>(joint); }

Vector3d world(const Anchor& anchor, const Pose& pose) {
  return pose.position[index(anchor.joint)] + pose.rotation[index(anchor.joint)] * anchor.local;
}

/// Builds the capsules on the skeleton at rest, where all joints' frames are parallel to the world.
class Fitter {
 public:
  explicit Fitter(const Clip& clip) : clip_(clip), body_(find_body_joints(clip)), rest_(rest_pose(clip.skeleton)) {}

  Figure fit() {
    measure_legs();
    find_hips();
    add_pelvis();
    for (const Side side : kSides) add_leg(side);
    add_torso();
    add_head();
    figure_.first_arm = figure_.capsules.size();
    for (const Side side : kSides) add_arm(side);
    return std::move(figure_);
  }

 private:
  Vector3d at(int joint) const { return rest_.position[index(joint)]; }
  /// A point of the rest pose, carried by a joint.
  Anchor carried(int joint, const Vector3d& point) const { return {joint, point - at(joint)}; }
  /// A point given in the hips frame, in the world at rest.
  Vector3d hips_point(double x, double y) const {
    return rest_hips_ + figure_.hips_axes.col(0) * x + figure_.hips_axes.col(1) * y;
  }
  Vector3d up() const { return figure_.hips_axes.col(1); }

  void add(const Anchor& a, const Anchor& b, double radius) { figure_.capsules.push_back({a, b, scale_ * radius}); }
  void add_bone(int from, int to, double radius) { add({from}, {to}, radius); }

  void measure_legs() {
    double sum = 0;
    for (const Limb& leg : body_.legs)
      sum += (at(leg.lower) - at(leg.upper)).norm() + (at(leg.end) - at(leg.lower)).norm();
    figure_.leg_length = sum / 2;
    if (!(figure_.leg_length > 0.2 && figure_.leg_length < 2)) {
      throw InputError(clip_.name, "legs " + std::to_string(figure_.leg_length) +
                                       " m long cannot be a human's; lengths are taken as centimetres");
    }
    scale_ = figure_.leg_length / human::kLegLength;
  }

  void find_hips() {
    const Vector3d left = at(body_.legs[kLeft].upper), right = at(body_.legs[kRight].upper);
    rest_hips_ = (left + right) / 2;
    half_hip_width_ = (left - right).norm() / 2;
    const Vector3d knees = (at(body_.legs[kLeft].lower) + at(body_.legs[kRight].lower)) / 2;
    const Vector3d above = body_.neck == kNoJoint ? Vector3d(2 * rest_hips_ - knees) : at(body_.neck);
    const Vector3d x = (left - right).normalized();
    const Vector3d z = x.cross(above - rest_hips_).normalized();
    if (!(std::min(x.norm(), z.norm()) > 0.5)) throw InputError(clip_.name, "hip joints and spine lie on one line");
    figure_.hips_axes << x, z.cross(x), z;
    figure_.hips = carried(body_.hips, rest_hips_);
  }

  void add_pelvis() {
    const double half_core = human::kPelvisWidth * half_hip_width_, height = scale_ * human::kPelvisHeight;
    add(carried(body_.hips, hips_point(-half_core, height)), carried(body_.hips, hips_point(half_core, height)),
        human::kPelvisRadius);
    // The waist goes round the section of the pelvis at its height, and round the torso, whose lower end it holds.
    figure_.waist_height = scale_ * human::kWaistHeight;
    const double rise = scale_ * (human::kWaistHeight - human::kPelvisHeight), radius = scale_ * human::kPelvisRadius;
    const double pelvis_reach = half_core + std::sqrt(radius * radius - rise * rise);
    figure_.waist_radius = std::max(pelvis_reach, scale_ * human::kTorsoRadius);
  }

  void add_leg(Side side) {
    const Limb& leg = body_.legs[side];
    add_bone(leg.upper, leg.lower, human::kThighRadius);
    add_bone(leg.lower, leg.end, human::kShinRadius);
    add({leg.end}, carried(leg.end, foot_tip(side)), human::kFootRadius);
    figure_.feet[side] = figure_.capsules.size() - 1;
  }

  Vector3d foot_tip(Side side) const {
    const int foot = body_.legs[side].end;
    const auto plausible = [&](const Vector3d& tip) {
      const double length = (tip - at(foot)).norm() / scale_;
      return length > 0.5 * human::kFootLength && length < 2 * human::kFootLength;
    };
    if (const int toe = body_.toes[side]; toe != kNoJoint && plausible(at(toe))) return at(toe);
    if (const auto& end = clip_.skeleton.joints[index(foot)].end_site) {
      if (const Vector3d tip = at(foot) + *end * kMetresPerUnit; plausible(tip)) return tip;
    }
    return at(foot) + scale_ * human::kFootLength * figure_.hips_axes.col(2);
  }

  /// From the middle of the waist, held by the hips so that a waistband stays round it, to the chest.
  void add_torso() {
    if (body_.neck == kNoJoint) return;
    const int chest = clip_.skeleton.joints[index(body_.neck)].parent;
    const Vector3d top = at(body_.neck) - scale_ * human::kTorsoBelowNeck * up();
    add(carried(body_.hips, hips_point(0, figure_.waist_height)), carried(chest, top), human::kTorsoRadius);
    const int left = body_.arms[kLeft].upper, right = body_.arms[kRight].upper;
    if (left != kNoJoint && right != kNoJoint) add_bone(left, right, human::kShoulderRadius);
  }

  void add_head() {
    if (body_.head == kNoJoint) return;
    if (body_.neck != kNoJoint) add_bone(body_.neck, body_.head, human::kNeckRadius);
    const Vector3d joint = at(body_.head);
    add(carried(body_.head, joint + scale_ * human::kHeadBottom * up()),
        carried(body_.head, joint + scale_ * human::kHeadTop * up()), human::kHeadRadius);
  }

  void add_arm(Side side) {
    const Limb& arm = body_.arms[side];
    if (arm.upper == kNoJoint) return;
    add_bone(arm.upper, arm.lower, human::kUpperArmRadius);
    add_bone(arm.lower, arm.end, human::kForearmRadius);
    const Vector3d along = (at(arm.end) - at(arm.lower)).normalized();
    add({arm.end}, carried(arm.end, at(arm.end) + scale_ * human::kHandLength * along), human::kHandRadius);
  }

  const Clip& clip_;
  const BodyJoints body_;
  const Pose rest_;
  Vector3d rest_hips_;
  double half_hip_width_ = 0;
  double scale_ = 1;
  Figure figure_;
};

}  // namespace

Figure fit_figure(const Clip& clip) { return Fitter(clip).fit(); }

std::vector<CapsulePose> capsules_at(const Figure& figure, const Pose& pose) {
  std::vector<CapsulePose> poses;
  poses.reserve(figure.capsules.size());
  for (const BodyCapsule& capsule : figure.capsules) {
    poses.push_back({world(capsule.a, pose).cast<float>(), world(capsule.b, pose).cast<float>(),
                     static_cast<float>(capsule.radius)});
  }
  return poses;
}

Eigen::Isometry3d hips_at(const Figure& figure, const Pose& pose) {
  Eigen::Isometry3d hips = Eigen::Isometry3d::Identity();
  hips.linear() = pose.rotation[index(figure.hips.joint)] * figure.hips_axes;
  hips.translation() = world(figure.hips, pose);
  return hips;
}

double ground_height(const Figure& figure, const Clip& clip) {
  double lowest = std::numeric_limits<double>::max();
  for (std::size_t frame = 0; frame < clip.frame_count(); ++frame) {
    const Pose pose = pose_at_frame(clip, frame);
    for (const std::size_t i : figure.feet) {
      const BodyCapsule& foot = figure.capsules[i];
      lowest = std::min({lowest, world(foot.a, pose).y() - foot.radius, world(foot.b, pose).y() - foot.radius});
    }
  }
  return lowest;
}

std::size_t calibration_frames(const Figure& figure, const Clip& clip) {
  constexpr std::size_t kSearched = 10;
  constexpr double kFastest = 12.0;  // m/s; a sprinting foot reaches 9 against the hips
  const auto ends_at = [&](std::size_t frame) {
    const Pose pose = pose_at_frame(clip, frame);
    std::vector<Vector3d> ends;
    for (const BodyCapsule& capsule : figure.capsules)
      ends.push_back(world(capsule.b, pose) - world(figure.hips, pose));
    return ends;
  };
  std::size_t count = 0;
  std::vector<Vector3d> before = ends_at(0);
  for (std::size_t frame = 1; frame < std::min(kSearched + 1, clip.frame_count()); ++frame) {
    std::vector<Vector3d> now = ends_at(frame);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if ((now[i] - before[i]).norm() > kFastest * clip.frame_time) count = frame;
    }
    before = std::move(now);
  }
  return count;
}

}  // namespace pleat::demo
