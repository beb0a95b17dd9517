#include "engine/registry.h"

#include <gtest/gtest.h>

#include "tests/components/failing_memory.h"

namespace pleat {
namespace {

class RegistryTest : public testing::Test {
 protected:
  Registry registry{std::pmr::new_delete_resource()};
  Handle add() {
    registry.reserve_one();
    return registry.add();
  }
};

TEST_F(RegistryTest, ZeroHandleIsNeverValid) {
  EXPECT_FALSE(registry.find({}));
  add();
  EXPECT_FALSE(registry.find({}));
  EXPECT_FALSE(registry.find({0, 2}));
  EXPECT_FALSE(registry.find({7, 1}));
}

TEST_F(RegistryTest, RemovingMovesTheLaterOnesDown) {
  const Handle a = add(), b = add(), c = add(), d = add();
  registry.remove(1);
  EXPECT_EQ(registry.find(a), 0u);
  EXPECT_FALSE(registry.find(b));
  EXPECT_EQ(registry.find(c), 1u);
  EXPECT_EQ(registry.find(d), 2u);
  EXPECT_EQ(registry.size(), 3u);
}

TEST_F(RegistryTest, SlotIsReusedUnderANewGeneration) {
  const Handle a = add();
  registry.remove(0);
  const Handle b = add();
  EXPECT_EQ(b.index, a.index);
  EXPECT_EQ(b.generation, a.generation + 1);
  EXPECT_FALSE(registry.find(a));
  EXPECT_EQ(registry.find(b), 0u);
}

TEST_F(RegistryTest, SurvivesAnyOrderOfAddingAndRemoving) {
  std::vector<Handle> live;
  std::uint32_t seed = 1;
  for (int step = 0; step < 2000; ++step) {
    seed = seed * 1664525u + 1013904223u;
    if (live.empty() || (seed >> 16) % 3 != 0) {
      live.push_back(add());
    } else {
      const std::size_t gone = (seed >> 8) % live.size();
      const Handle handle = live[gone];
      registry.remove(*registry.find(handle));
      live.erase(live.begin() + static_cast<std::ptrdiff_t>(gone));
      EXPECT_FALSE(registry.find(handle));
    }
    ASSERT_EQ(registry.size(), live.size());
    for (std::uint32_t i = 0; i < live.size(); ++i) ASSERT_EQ(registry.find(live[i]), i);
  }
}

TEST(Registry, AddAfterReserveNeedsNoMemory) {
  FailingMemory memory(100);
  Registry registry(&memory);
  for (int i = 0; i < 20; ++i) {
    memory.allow(100);
    registry.reserve_one();
    memory.allow(0);
    registry.add();
  }
  for (std::uint32_t i = 20; i-- > 0;) registry.remove(i);  // nor does remove
}

TEST(Registry, FailureToReserveChangesNothing) {
  for (int allowed = 0; allowed < 3; ++allowed) {
    FailingMemory memory(100);
    Registry registry(&memory);
    registry.reserve_one();
    const Handle a = registry.add();
    memory.allow(allowed);
    const auto fill = [&] {
      while (registry.size() < 1000) {
        registry.reserve_one();
        registry.add();
      }
    };
    EXPECT_THROW(fill(), std::bad_alloc);
    const std::uint32_t size = registry.size();
    EXPECT_THROW(registry.reserve_one(), std::bad_alloc);
    EXPECT_EQ(registry.find(a), 0u);
    EXPECT_EQ(registry.size(), size);
  }
}

}  // namespace
}  // namespace pleat
