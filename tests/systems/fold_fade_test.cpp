#include "systems/fold_fade.h"

#include <gtest/gtest.h>

namespace pleat {
namespace {

TEST(FoldFade, RefusesToRunWithAFieldMissingOrAShareThatIsNone) {
  float height[3] = {1.0f, -2.0f, 0.0f};
  const FoldFade good{.edge_count = 3, .share = 0.5f, .fold_height = height};
  ASSERT_TRUE(good.validate());
  FoldFade bad = good;
  bad.fold_height = nullptr;
  EXPECT_FALSE(bad.validate());
  for (const float share : {-0.1f, 1.1f}) {
    bad = good, bad.share = share;
    EXPECT_FALSE(bad.validate()) << share;
  }
}

TEST(FoldFade, LeavesAShareOfEachHeightOnEitherSideAndNothingBeyondTheEdges) {
  float height[4] = {1.0f, -2.0f, 0.0f, 4.0f};
  FoldFade{.edge_count = 3, .share = 0.25f, .fold_height = height}.run();
  const float expected[4] = {0.25f, -0.5f, 0.0f, 4.0f};
  for (int e = 0; e < 4; ++e) EXPECT_EQ(height[e], expected[e]) << e;
}

}  // namespace
}  // namespace pleat
