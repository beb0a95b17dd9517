#include "components/walk.h"

#include <gtest/gtest.h>

namespace pleat {
namespace {

using Indices = std::vector<std::uint32_t>;

// 0 - 1 - 2 - 3 - 0, a tail 2 - 4 and, apart, 5 - 6
constexpr EdgeEnds kEdges[] = {{2, 3}, {0, 1}, {1, 2}, {0, 3}, {2, 4}, {5, 6}};

TEST(Walk, ComesToNearParticlesFirst) {
  const Walk walk(Indices{0}, 7, kEdges);
  EXPECT_EQ(walk.order, (Indices{0, 1, 3, 2, 4}));
  EXPECT_EQ(walk.hops, (Indices{0, 1, 2, 1, 3, Walk::kNever, Walk::kNever}));
  EXPECT_EQ(walk.depth(), 3u);
}

TEST(Walk, CountsFromTheNearestStart) {
  const Walk walk(Indices{4, 0, 6}, 7, kEdges);
  EXPECT_EQ(walk.order, (Indices{4, 0, 6, 2, 1, 3, 5}));
  EXPECT_EQ(walk.hops, (Indices{0, 1, 1, 1, 0, 1, 0}));
  EXPECT_EQ(walk.depth(), 1u);
}

TEST(Walk, FromNowhereComesNowhere) {
  const Walk walk({}, 7, kEdges);
  EXPECT_TRUE(walk.order.empty());
  EXPECT_EQ(walk.hops, Indices(7, Walk::kNever));
  EXPECT_EQ(walk.depth(), 0u);
}

}  // namespace
}  // namespace pleat
