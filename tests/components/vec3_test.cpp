#include "components/vec3.h"

#include <gtest/gtest.h>

#include <limits>

namespace pleat {
namespace {

TEST(Vec3, CrossIsRightHanded) {
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(cross(Vec3{0, 0, 1}, Vec3{1, 0, 0}), (Vec3{0, 1, 0}));
}

TEST(Vec3, NormalizedFallsBackWhereThereIsNoDirection) {
  EXPECT_EQ(normalized_or(Vec3{0, 3, 4} * 0.5f, Vec3{}), (Vec3{0, 0.6f, 0.8f}));
  EXPECT_EQ(normalized_or(Vec3{}, Vec3{0, 1, 0}), (Vec3{0, 1, 0}));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(normalized_or(Vec3{nan, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 1, 0}));
}

TEST(Vec3, KnowsWhatIsFinite) {
  EXPECT_TRUE(is_finite(Vec3{1, -2, 1e38f}));
  EXPECT_FALSE(is_finite(Vec3{0, std::numeric_limits<float>::infinity(), 0}));
  EXPECT_FALSE(is_finite(Vec3{0, 0, std::numeric_limits<float>::quiet_NaN()}));
}

}  // namespace
}  // namespace pleat
