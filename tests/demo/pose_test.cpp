#include "demo/motion/pose.h"

#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "demo/motion/bvh.h"

namespace pleat::demo {
namespace {

using Eigen::Vector3d;

/// A two-bone arm: a root at (1, 2, 3) with six channels, an elbow 10 up and a hand 5 further.
Clip arm(const std::string& root_channels, const std::string& frames, int frame_count) {
  std::istringstream stream("HIERARCHY ROOT root { OFFSET 1 2 3 CHANNELS " + root_channels +
                            " JOINT elbow { OFFSET 0 10 0 CHANNELS 3 Zrotation Xrotation Yrotation"
                            " JOINT hand { OFFSET 0 5 0 } } }\nMOTION\nFrames: " +
                            std::to_string(frame_count) + "\nFrame Time: 0.5\n" + frames);
  return read_bvh(stream, "arm.bvh");
}

void expect_near(const Vector3d& actual, const Vector3d& expected, double tolerance = 1e-12) {
  EXPECT_LT((actual - expected).norm(), tolerance) << actual.transpose() << " for " << expected.transpose();
}

TEST(Pose, RestIsTheOffsetsInMetres) {
  const Clip clip = arm("3 Zrotation Xrotation Yrotation", "10 20 30 40 50 60", 1);
  const Pose pose = rest_pose(clip.skeleton);
  expect_near(pose.position[0], {0.01, 0.02, 0.03});
  expect_near(pose.position[2], {0.01, 0.17, 0.03});
}

TEST(Pose, PositionsReplaceTheOffset) {
  const Clip clip = arm("2 Zposition Xposition", "70 80 0 0 0", 1);
  expect_near(pose_at_frame(clip, 0).position[0], {0.8, 0.02, 0.7});  // y is not animated: the offset holds
}

TEST(Pose, RotationsTurnTheBonesBelow) {
  const Clip clip = arm("3 Zrotation Xrotation Yrotation", "90 0 0 0 90 0", 1);
  const Pose pose = pose_at_frame(clip, 0);
  expect_near(pose.position[1], Vector3d(1, 2, 3) / 100 + Vector3d(-0.1, 0, 0));  // up turns to -x about z
  expect_near(pose.position[2], pose.position[1] + Vector3d(0, 0, 0.05));         // up turns to z about x
}

TEST(Pose, RotationsMultiplyInFileOrder) {
  // Y then X: the bone first tips to z about x, then turns to x about y. X then Y: y leaves the upright bone alone.
  expect_near(pose_at_frame(arm("2 Yrotation Xrotation", "90 90 0 0 0", 1), 0).position[1],
              Vector3d(1, 2, 3) / 100 + Vector3d(0.1, 0, 0));
  expect_near(pose_at_frame(arm("2 Xrotation Yrotation", "90 90 0 0 0", 1), 0).position[1],
              Vector3d(1, 2, 3) / 100 + Vector3d(0, 0, 0.1));
}

TEST(Pose, InterpolatesBetweenFrames) {
  const Clip clip = arm("4 Xposition Zrotation Xrotation Yrotation", "0 170 0 0 0 0 0\n10 -170 0 0 0 0 0", 2);
  const Pose half = pose_at(clip, 0.25);  // 170 to -170 degrees goes through 180, not through 0
  expect_near(half.position[0], {0.05, 0.02, 0.03});
  expect_near(half.position[1], {0.05, 0.02 - 0.1, 0.03});
  const Pose quarter = pose_at(clip, 0.125);
  EXPECT_NEAR(quarter.rotation[0].angularDistance(half.rotation[0]), 5 * std::numbers::pi / 180, 1e-12);
}

TEST(Pose, HoldsTheEndsOfTheClip) {
  const Clip clip = arm("1 Xposition", "10 0 0 0\n20 0 0 0\n40 0 0 0", 3);
  expect_near(pose_at(clip, -1).position[0], {0.1, 0.02, 0.03});
  expect_near(pose_at(clip, 0.5).position[0], {0.2, 0.02, 0.03});
  expect_near(pose_at(clip, 1).position[0], {0.4, 0.02, 0.03});
  expect_near(pose_at(clip, 1e300).position[0], {0.4, 0.02, 0.03});
  expect_near(pose_at(clip, std::numeric_limits<double>::quiet_NaN()).position[0], {0.1, 0.02, 0.03});
}

TEST(Pose, StepsFromRestIntoTheFirstFrame) {
  const Clip clip = arm("4 Xposition Zrotation Xrotation Yrotation", "10 90 0 0 0 80 0\n0 0 0 0 0 0 0", 2);
  const Pose rest = pose_to_first_frame(clip, 0.0), half = pose_to_first_frame(clip, 0.5);
  const Pose first = pose_at_frame(clip, 0);
  for (const Pose* pose : {&rest, &half}) {  // the root waits where it will be needed
    expect_near(pose->position[0], first.position[0]);
    EXPECT_EQ(pose->rotation[0].angularDistance(first.rotation[0]), 0.0);
  }
  const double whole = rest.rotation[1].angularDistance(first.rotation[1]);
  EXPECT_NEAR(whole, 80 * std::numbers::pi / 180, 1e-9);
  EXPECT_NEAR(half.rotation[1].angularDistance(first.rotation[1]), 0.5 * whole, 1e-9);
  EXPECT_NEAR(pose_to_first_frame(clip, 1.0).rotation[1].angularDistance(first.rotation[1]), 0.0, 1e-9);
}

/// Assimp as an oracle: its nodes and animation channels, put together here, must place every joint where we do.
/// It too lets position channels replace the root's offset; it keeps end sites as nodes of their own.
class AgainstAssimp : public testing::TestWithParam<const char*> {
 protected:
  static aiMatrix4x4 local(const aiScene& scene, const aiNode& node, std::size_t frame) {
    const aiAnimation& animation = *scene.mAnimations[0];
    for (unsigned i = 0; i < animation.mNumChannels; ++i) {
      const aiNodeAnim& channel = *animation.mChannels[i];
      if (channel.mNodeName != node.mName) continue;
      const auto key = [frame](unsigned count) { return std::min<std::size_t>(frame, count - 1); };
      const aiVector3D position = channel.mPositionKeys[key(channel.mNumPositionKeys)].mValue;
      const aiQuaternion rotation = channel.mRotationKeys[key(channel.mNumRotationKeys)].mValue;
      return aiMatrix4x4(aiVector3D(1, 1, 1), rotation, position);
    }
    return node.mTransformation;
  }

  static aiMatrix4x4 global(const aiScene& scene, const aiNode* node, std::size_t frame) {
    const aiMatrix4x4 own = local(scene, *node, frame);
    return node->mParent ? global(scene, node->mParent, frame) * own : own;
  }
};

TEST_P(AgainstAssimp, JointsStandInTheSamePlaces) {
  const std::string path = std::string(PLEAT_SHARED_DATA "/mocap/") + GetParam() + ".bvh";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no recording " << path;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumAnimations, 1u);

  const Clip clip = load_bvh(path);
  for (const std::size_t frame : {std::size_t{0}, std::size_t{1}, clip.frame_count() / 2, clip.frame_count() - 1}) {
    const Pose pose = pose_at_frame(clip, frame);
    for (std::size_t i = 0; i < clip.skeleton.joints.size(); ++i) {
      const std::string& name = clip.skeleton.joints[i].name;
      const aiNode* node = scene->mRootNode->FindNode(name.c_str());
      ASSERT_NE(node, nullptr) << name;
      const aiMatrix4x4 placed = global(*scene, node, frame);
      expect_near(pose.position[i], Vector3d(placed.a4, placed.b4, placed.c4) * kMetresPerUnit, 1e-5);  // its floats
      if (HasFailure()) FAIL() << name << " in frame " << frame;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Recordings, AgainstAssimp,
                         testing::Values("mass_kick", "mass_walk", "mass_pirouette", "cmu_05_03_dance_arabesque",
                                         "cmu_13_13_forward_jump"));

}  // namespace
}  // namespace pleat::demo
