#include "systems/box.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace pleat {
namespace {

TEST(Box, HoldsItsPointsAndNoMoreHoweverMany) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-3.0f, 3.0f);
  for (std::size_t count = 0; count < 40; ++count) {
    Vec3Column points(std::pmr::new_delete_resource());
    points.resize(count);
    Box expected;
    for (std::size_t i = 0; i < count; ++i) {
      Vec3 p{any(random), any(random), any(random)};
      if (random() % 10 == 0) p.y = std::numeric_limits<float>::quiet_NaN();
      points.view().set(i, p);
      expected.include(p);
    }
    const Box box = box_of(points.view(), count);
    EXPECT_EQ(box.low, expected.low) << count;
    EXPECT_EQ(box.high, expected.high) << count;
  }
}

}  // namespace
}  // namespace pleat
