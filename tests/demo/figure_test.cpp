#include "demo/motion/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "demo/input_error.h"
#include "demo/motion/body_joints.h"
#include "demo/motion/bvh.h"

namespace pleat::demo {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// What the joints of a test body are called; an empty name leaves the joint and all below it out.
using Names = std::map<std::string, std::string>;
const Names kPlain = {{"hips", "Hips"},        {"spine", "Spine"},        {"neck", "Neck"},
                      {"head", "Head"},        {"l_arm", "LeftArm"},      {"l_forearm", "LeftForeArm"},
                      {"l_hand", "LeftHand"},  {"r_arm", "RightArm"},     {"r_forearm", "RightForeArm"},
                      {"r_hand", "RightHand"}, {"l_thigh", "LeftUpLeg"},  {"l_shin", "LeftLeg"},
                      {"l_foot", "LeftFoot"},  {"r_thigh", "RightUpLeg"}, {"r_shin", "RightLeg"},
                      {"r_foot", "RightFoot"}};

Names renamed(Names names, const std::string& joint, const std::string& name) {
  names.at(joint) = name;
  return names;
}

std::string joint(const std::string& name, const std::string& offset, const std::string& below = "") {
  if (name.empty()) return "";
  return " JOINT " + name + " { OFFSET " + offset + " CHANNELS 1 Yrotation" + below + " }";
}

/// A standing body whose legs are those of the benchmark's skirt scene: hip joints at (-+9, 90, 0) cm, bones of 42 cm.
Clip body(const Names& n, const std::string& root = "0 90 0 0") {
  std::string text =
      "HIERARCHY ROOT " + n.at("hips") + " { OFFSET 0 0 0 CHANNELS 4 Xposition Yposition Zposition Yrotation";
  const auto leg = [&](const std::string& side, const std::string& x) {
    return joint(
        n.at(side + "_thigh"), x + " 0 0",
        joint(n.at(side + "_shin"), "0 -42 0", joint(n.at(side + "_foot"), "0 -42 0", " End Site { OFFSET 0 -3 15 }")));
  };
  const auto arm = [&](const std::string& side, const std::string& x, const std::string& bone) {
    return joint(n.at(side + "_arm"), x + " 20 0",
                 joint(n.at(side + "_forearm"), bone + " 0 0",
                       joint(n.at(side + "_hand"), bone + " 0 0", " End Site { OFFSET 160 0 0 }")));
  };
  text += joint(
      n.at("spine"), "0 25 0",
      joint(n.at("neck"), "0 28 0", joint(n.at("head"), "0 9 0")) + arm("l", "17", "26") + arm("r", "-17", "-26"));
  text += leg("l", "9") + leg("r", "-9") + " }\nMOTION\nFrames: 1\nFrame Time: 0.1\n" + root;
  std::istringstream counting(text);
  for (std::string word; counting >> word;) text += word == "JOINT" ? " 0" : "";
  std::istringstream stream(text);
  return read_bvh(stream, "body.bvh");
}

void expect_capsule(const CapsulePose& capsule, const Vector3f& a, const Vector3f& b, float radius) {
  EXPECT_LT((capsule.a - a).norm(), 1e-6f) << capsule.a.transpose();
  EXPECT_LT((capsule.b - b).norm(), 1e-6f) << capsule.b.transpose();
  EXPECT_FLOAT_EQ(capsule.radius, radius);
}

std::vector<CapsulePose> standing(const Clip& clip) { return capsules_at(fit_figure(clip), pose_at_frame(clip, 0)); }

TEST(Figure, HasTheProportionsOfTheSkirtScene) {
  const Clip clip = body(kPlain);
  const Figure figure = fit_figure(clip);
  EXPECT_NEAR(figure.leg_length, 0.84, 1e-12);
  EXPECT_NEAR(figure.waist_height, 0.15, 1e-12);
  EXPECT_NEAR(figure.waist_radius, 0.115, 1e-12);
  EXPECT_NEAR(ground_height(figure, clip), 0.06 - 0.03 - 0.045, 1e-12);

  const auto capsules = standing(clip);
  ASSERT_EQ(capsules.size(), 17u);
  expect_capsule(capsules[0], {-0.0495f, 0.95f, 0}, {0.0495f, 0.95f, 0}, 0.11f);    // pelvis
  expect_capsule(capsules[4], {-0.09f, 0.90f, 0}, {-0.09f, 0.48f, 0}, 0.075f);      // right thigh
  expect_capsule(capsules[5], {-0.09f, 0.48f, 0}, {-0.09f, 0.06f, 0}, 0.055f);      // right shin
  expect_capsule(capsules[6], {-0.09f, 0.06f, 0}, {-0.09f, 0.03f, 0.15f}, 0.045f);  // right foot
  expect_capsule(capsules[7], {0, 1.05f, 0}, {0, 1.29f, 0}, 0.115f);                // torso
}

TEST(Figure, ScalesWithTheLegs) {
  std::istringstream giant(
      "HIERARCHY ROOT hip { OFFSET 0 0 0 CHANNELS 1 Yposition"
      " JOINT lThigh { OFFSET 18 0 0 JOINT lShin { OFFSET 0 -84 0 JOINT lFoot { OFFSET 0 -84 0 } } }"
      " JOINT rThigh { OFFSET -18 0 0 JOINT rShin { OFFSET 0 -84 0 JOINT rFoot { OFFSET 0 -84 0 } } } }\n"
      "MOTION Frames: 1 Frame Time: 1\n180");
  const Clip clip = read_bvh(giant, "giant.bvh");
  const auto capsules = standing(clip);
  ASSERT_EQ(capsules.size(), 7u) << "pelvis and legs; there is nothing above";
  expect_capsule(capsules[0], {-0.099f, 1.90f, 0}, {0.099f, 1.90f, 0}, 0.22f);
  expect_capsule(capsules[3], {0.18f, 0.12f, 0}, {0.18f, 0.12f, 0.30f}, 0.09f);  // no toe, no end site: straight ahead
}

TEST(Figure, HipsFrameFollowsTheBody) {
  const Clip clip = body(kPlain, "100 80 -20 90");  // turned to its left: it looks along +x
  const Figure figure = fit_figure(clip);
  const Eigen::Isometry3d hips = hips_at(figure, pose_at_frame(clip, 0));
  EXPECT_TRUE(hips.translation().isApprox(Vector3d(1, 0.8, -0.2)));
  EXPECT_TRUE((hips.linear() * Vector3d::UnitX()).isApprox(-Vector3d::UnitZ())) << "left";
  EXPECT_TRUE((hips.linear() * Vector3d::UnitY()).isApprox(Vector3d::UnitY())) << "up";
  EXPECT_TRUE((hips.linear() * Vector3d::UnitZ()).isApprox(Vector3d::UnitX())) << "forward";
  expect_capsule(standing(clip)[0], {1, 0.85f, -0.2f + 0.0495f}, {1, 0.85f, -0.2f - 0.0495f}, 0.11f);
}

TEST(Figure, WaistGoesRoundPelvisAndTorso) {
  const Clip clip = body(kPlain);
  const Figure figure = fit_figure(clip);
  const auto capsules = capsules_at(figure, pose_at_frame(clip, 0));
  const Vector3d centre = hips_at(figure, pose_at_frame(clip, 0)) * Vector3d(0, figure.waist_height, 0);
  for (int degrees = 0; degrees < 360; degrees += 5) {
    const double angle = degrees * 3.14159265358979 / 180;
    const Vector3f at =
        (centre + (figure.waist_radius + 1e-6) * Vector3d(std::sin(angle), 0, std::cos(angle))).cast<float>();
    for (const CapsulePose& capsule : capsules) {
      const Vector3f core = capsule.b - capsule.a;
      const float along = std::clamp((at - capsule.a).dot(core) / core.squaredNorm(), 0.0f, 1.0f);
      EXPECT_GE((at - capsule.a - along * core).norm(), capsule.radius) << degrees;
    }
  }
}

TEST(Figure, KnowsTheNamesInUse) {
  const auto expected = standing(body(kPlain));
  const auto prefixed = [](const std::string& prefix) {
    Names names = kPlain;
    for (auto& [part, name] : names) name = prefix + name;
    return names;
  };
  const Names cmu = {{"hips", "hip"},           {"spine", "abdomen"},  {"neck", "neck"},          {"head", "head"},
                     {"l_arm", "lShldr"},       {"l_hand", "lHand"},   {"l_forearm", "lForeArm"}, {"r_arm", "rShldr"},
                     {"r_forearm", "rForeArm"}, {"r_hand", "rHand"},   {"l_thigh", "lThigh"},     {"l_shin", "lShin"},
                     {"l_foot", "lFoot"},       {"r_thigh", "rThigh"}, {"r_shin", "rShin"},       {"r_foot", "rFoot"}};
  const Names joints = {{"hips", "Hips"},         {"spine", "Chest"},         {"neck", "Neck"},
                        {"head", "Head"},         {"l_arm", "LeftShoulder"},  {"l_forearm", "LeftElbow"},
                        {"l_hand", "LeftWrist"},  {"r_arm", "RightShoulder"}, {"r_forearm", "RightElbow"},
                        {"r_hand", "RightWrist"}, {"l_thigh", "LeftHip"},     {"l_shin", "LeftKnee"},
                        {"l_foot", "LeftAnkle"},  {"r_thigh", "RightHip"},    {"r_shin", "RightKnee"},
                        {"r_foot", "RightAnkle"}};
  const Names side_last = {
      {"hips", "pelvis"},          {"spine", "spine_01"},       {"neck", "neck_01"},    {"head", "head"},
      {"l_arm", "upperarm_l"},     {"l_forearm", "lowerarm_l"}, {"l_hand", "hand_l"},   {"r_arm", "upperarm_r"},
      {"r_forearm", "lowerarm_r"}, {"r_hand", "hand_r"},        {"l_thigh", "thigh_l"}, {"l_shin", "calf_l"},
      {"l_foot", "foot_l"},        {"r_thigh", "thigh_r"},      {"r_shin", "calf_r"},   {"r_foot", "foot_r"}};
  for (const Names& names : {prefixed("Character1_"), prefixed("mixamorig:"), cmu, joints, side_last}) {
    const auto capsules = standing(body(names));
    ASSERT_EQ(capsules.size(), expected.size()) << names.at("l_thigh");
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      expect_capsule(capsules[i], expected[i].a, expected[i].b, expected[i].radius);
    }
  }
}

TEST(Figure, HelperJointsDoNoHarm) {
  const auto expected = standing(body(kPlain));
  std::istringstream helped(
      "HIERARCHY ROOT Hips { OFFSET 0 0 0 CHANNELS 1 Yposition"
      " JOINT Pelvis { OFFSET 0 0 0 } JOINT L_Femur { OFFSET 200 0 0 } JOINT LeftLeg_ { OFFSET 300 0 0 }"
      " JOINT LeftUpLeg { OFFSET 9 0 0 JOINT L_Leg_Mesh { OFFSET 120 0 0 }"
      "   JOINT LeftLeg { OFFSET 0 -42 0"
      "     JOINT LeftFoot { OFFSET 0 -42 0 JOINT L_Foot { OFFSET 150 9 9 } End Site { OFFSET 0 -3 15 } }"
      "     JOINT L_Tibia { OFFSET 0 0 0 } } }"
      " JOINT RightUpLeg { OFFSET -9 0 0"
      "   JOINT RightLeg { OFFSET 0 -42 0"
      "     JOINT RightFoot { OFFSET 0 -42 0 JOINT RightToeBase { OFFSET 170 0 0 } End Site { OFFSET 0 -3 15 } } } } "
      "}\n"
      "MOTION Frames: 1 Frame Time: 1\n90");
  const auto capsules = standing(read_bvh(helped, "helped.bvh"));
  ASSERT_EQ(capsules.size(), 7u);
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    expect_capsule(capsules[i], expected[i].a, expected[i].b, expected[i].radius);
  }
}

void expect_refused(const Clip& clip, const std::string& says) {
  try {
    fit_figure(clip);
    FAIL() << "accepted in spite of: " << says;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(Figure, MissingPartsAreNamed) {
  expect_refused(body(renamed(kPlain, "r_thigh", "")),
                 "body.bvh: no joint for the right hip joint; the joints are Hips, Spine, Neck");
  expect_refused(body(renamed(kPlain, "l_shin", "LeftStump")), "no joint for the left knee");
  expect_refused(body(renamed(kPlain, "r_foot", "")), "no joint for the right foot");
}

TEST(Figure, ArmsNeckAndHeadMayBeMissing) {
  EXPECT_EQ(standing(body(renamed(kPlain, "l_hand", "Hook"))).size(), 17u - 4u);  // its arm, and the shoulders
  EXPECT_EQ(standing(body(renamed(kPlain, "head", ""))).size(), 17u - 2u);
  EXPECT_EQ(standing(body(renamed(kPlain, "spine", ""))).size(), 7u);
}

TEST(Figure, ImpossibleBodiesAreRefused) {
  const auto legs = [](const std::string& left, const std::string& right, const std::string& bone) {
    const std::string below = "{ OFFSET 0 " + bone + " 0 ";
    std::istringstream stream("HIERARCHY ROOT hip { OFFSET 0 0 0 CHANNELS 1 Yposition JOINT lThigh { OFFSET " + left +
                              " JOINT lShin " + below + "JOINT lFoot " + below + "} } } JOINT rThigh { OFFSET " +
                              right + " JOINT rShin " + below + "JOINT rFoot " + below +
                              "} } } }\nMOTION Frames: 1 Frame Time: 1\n0");
    return read_bvh(stream, "legs.bvh");
  };
  EXPECT_NO_THROW(fit_figure(legs("9 0 0", "-9 0 0", "-42")));
  expect_refused(legs("9 0 0", "-9 0 0", "-0.42"), "legs.bvh: legs 0.008400 m long");
  expect_refused(legs("9 0 0", "-9 0 0", "0"), "legs 0.000000 m long");
  expect_refused(legs("9 0 0", "-9 0 0", "-4200"), "cannot be a human's");
  expect_refused(legs("9 0 0", "9 0 0", "-42"), "lie on one line");

  std::istringstream hanging(
      "HIERARCHY ROOT lThigh { OFFSET 0 0 0 CHANNELS 1 Yposition JOINT lShin { OFFSET 0 -42 0 JOINT lFoot { OFFSET 0 "
      "-42 0 } }"
      " JOINT rThigh { OFFSET -18 0 0 JOINT rShin { OFFSET 0 -42 0 JOINT rFoot { OFFSET 0 -42 0 } } } }\n"
      "MOTION Frames: 1 Frame Time: 1\n90");
  expect_refused(read_bvh(hanging, "hanging.bvh"), "no hips joint: one leg hangs from the other");
}

std::size_t joint_named(const Clip& clip, const std::string& name) {
  for (std::size_t i = 0; i < clip.skeleton.joints.size(); ++i) {
    if (clip.skeleton.joints[i].name == name) return i;
  }
  throw std::out_of_range(name);
}

class Recording : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    path_ = std::string(PLEAT_SHARED_DATA "/mocap/") + GetParam() + ".bvh";
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << "no recording " << path_;
  }
  std::string path_;
};

TEST_P(Recording, IsFittedWithAWholeBody) {
  const Clip clip = load_bvh(path_, 4);
  const Figure figure = fit_figure(clip);
  EXPECT_NEAR(figure.leg_length, 0.84, 0.03);
  EXPECT_NEAR(figure.waist_radius, 0.115, 0.005);
  ASSERT_EQ(figure.capsules.size(), 17u);
  const double ground = ground_height(figure, clip);
  for (std::size_t frame = 0; frame < clip.frame_count(); ++frame) {
    const Pose pose = pose_at_frame(clip, frame);
    const Eigen::Isometry3d hips = hips_at(figure, pose);
    EXPECT_TRUE((hips.linear().transpose() * hips.linear()).isIdentity(1e-9));
    for (const CapsulePose& capsule : capsules_at(figure, pose)) {
      ASSERT_TRUE(capsule.a.allFinite() && capsule.b.allFinite());
      ASSERT_LT((capsule.a - capsule.b).norm(), 0.55f) << "longer than any bone";
      ASSERT_LT((capsule.a.cast<double>() - hips.translation()).norm(), 1.3) << "frame " << frame;
    }
    ASSERT_GT(hips.translation().y() - ground, 0.4) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Recording,
                         testing::Values("mass_kick", "mass_walk", "mass_run", "mass_pirouette", "mass_dance",
                                         "cmu_05_03_dance_arabesque", "cmu_13_13_forward_jump"));

TEST_P(Recording, LosesItsCalibrationFramesOnly) {
  const Clip clip = load_bvh(path_);
  const bool calibrated = std::string(GetParam()).starts_with("cmu");
  EXPECT_EQ(calibration_frames(fit_figure(clip), clip), calibrated ? 4u : 0u);
}

TEST(Figure, RecordedKickRisesOverTheHip) {
  const std::string path = PLEAT_SHARED_DATA "/mocap/mass_kick.bvh";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no recording " << path;
  const Clip clip = load_bvh(path);
  const Pose pose = pose_at_frame(clip, 75);
  const double rise = pose.position[joint_named(clip, "Character1_RightFoot")].y() -
                      pose.position[joint_named(clip, "Character1_Hips")].y();
  EXPECT_NEAR(rise, 0.179, 0.0005);
}

/// Our own clip: a person of 1.70 m who stands on the left foot and kicks with the right.
class Kick : public testing::Test {
 protected:
  Vector3d at(const std::string& name, std::size_t frame) const {
    return pose_at_frame(clip_, frame).position[joint_named(clip_, name)];
  }
  const Clip clip_ = load_bvh(PLEAT_SCENES "/kick.bvh");
  const Figure figure_ = fit_figure(clip_);
  const std::size_t last_ = clip_.frame_count() - 1;
};

TEST_F(Kick, IsAHumanOnTheGround) {
  EXPECT_NEAR(clip_.duration(), 2.5, 0.01);
  EXPECT_NEAR(ground_height(figure_, clip_), 0, 0.005);
  float top = 0;
  for (const CapsulePose& capsule : standing(clip_)) top = std::max(top, capsule.b.y() + capsule.radius);
  EXPECT_NEAR(top, 1.70f, 0.02f);
}

TEST_F(Kick, SupportFootStaysAndKickingFootComesBack) {
  for (std::size_t frame = 0; frame <= last_; ++frame) {
    EXPECT_LT((at("LeftFoot", frame) - at("LeftFoot", 0)).norm(), 0.001) << "frame " << frame;
  }
  EXPECT_LT((at("RightFoot", last_) - at("RightFoot", 0)).norm(), 0.001);
}

TEST_F(Kick, ReachesHipHeightInFront) {
  double highest = 0;
  std::size_t apex = 0;
  for (std::size_t frame = 0; frame <= last_; ++frame) {
    const double height = at("RightFoot", frame).y();
    if (height > highest) highest = height, apex = frame;
  }
  EXPECT_GT(highest, at("RightUpLeg", apex).y());
  EXPECT_LT(highest, at("RightUpLeg", apex).y() + 0.2);
  EXPECT_GT(at("RightFoot", apex).z() - at("RightUpLeg", apex).z(), 0.7);
  EXPECT_LT(std::abs(at("RightFoot", apex).x()), 0.2) << "forward, not to the side";
}

TEST_F(Kick, IsSmooth) {
  std::vector<Pose> poses;
  for (std::size_t frame = 0; frame <= last_; ++frame) poses.push_back(pose_at_frame(clip_, frame));
  const double per_second = 1 / clip_.frame_time;
  for (std::size_t joint = 0; joint < clip_.skeleton.joints.size(); ++joint) {
    const std::string& name = clip_.skeleton.joints[joint].name;
    const bool kicks = name == "RightFoot";
    for (std::size_t frame = 1; frame < last_; ++frame) {
      const Vector3d step = poses[frame + 1].position[joint] - poses[frame].position[joint];
      const Vector3d last_step = poses[frame].position[joint] - poses[frame - 1].position[joint];
      EXPECT_LT(step.norm() * per_second, kicks ? 7 : 3.5) << name << " in frame " << frame;
      EXPECT_LT((step - last_step).norm() * per_second * per_second, kicks ? 80 : 30) << name << " in frame " << frame;
    }
  }
}

}  // namespace
}  // namespace pleat::demo
