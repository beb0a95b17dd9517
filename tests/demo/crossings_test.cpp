#include "demo/quality/crossings.h"

#include <gtest/gtest.h>

#include <vector>

namespace pleat::demo {
namespace {

const std::vector<float> kFace = {0, 0, 0, 1, 0, 0, 0, 0, 1};

/// kFace and a second triangle.
Crossings with(const std::vector<float>& second) {
  std::vector<float> positions = kFace;
  positions.insert(positions.end(), second.begin(), second.end());
  return find_crossings(positions, std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
}

TEST(Crossings, TipThroughAFaceIsTwoEdgesAsDeepAsTheTip) {
  const Crossings found = with({0.2f, -0.03f, 0.2f, 0.2f, 1, 0.3f, 0.3f, 1, 0.2f});
  EXPECT_EQ(found.count, 2u);
  EXPECT_NEAR(found.deepest, 0.03, 1e-6);
}

TEST(Crossings, EdgesThatInterlockAreFoundBothWays) {
  // Each triangle reaches through the other's border: one edge of each through the other's inside.
  const Crossings found = with({0.3f, -0.2f, -0.1f, 0.3f, 0.5f, -0.1f, 0.3f, -0.2f, 0.6f});
  EXPECT_GE(found.count, 1u);
  EXPECT_LE(found.deepest, 0.5);
}

TEST(Crossings, ApartOrSharingACornerIsNone) {
  EXPECT_EQ(with({0.2f, 0.01f, 0.2f, 0.2f, 1, 0.3f, 0.3f, 1, 0.2f}).count, 0u);
  EXPECT_EQ(with({0.9f, -0.1f, 0.9f, 0.9f, 1, 0.9f, 1, 1, 1}).count, 0u);  // beside the face
  std::vector<float> fold = kFace;
  fold.insert(fold.end(), {0.3f, 0.0f, 0.3f});
  EXPECT_EQ(find_crossings(fold, std::vector<uint32_t>{0, 1, 2, 1, 0, 3}).count, 0u);
}

}  // namespace
}  // namespace pleat::demo
