#include "components/column.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/components/failing_memory.h"

namespace pleat {
namespace {

std::pmr::memory_resource* heap() { return std::pmr::new_delete_resource(); }

template <class T>
std::vector<T> values(const Column<T>& column) {
  return {column.begin(), column.end()};
}

TEST(Column, PadsToWholeGroups) {
  EXPECT_EQ(padded(0), 0u);
  EXPECT_EQ(padded(1), 16u);
  EXPECT_EQ(padded(16), 16u);
  EXPECT_EQ(padded(17), 32u);
}

TEST(Column, IsAlignedAndItsPaddingHoldsTheFillValue) {
  for (const std::size_t size : {1u, 15u, 16u, 17u, 100u}) {
    Column<float> column(heap(), -3.0f);
    column.resize(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(column.data()) % kColumnAlignment, 0u);
    ASSERT_EQ(column.bytes(), padded(size) * sizeof(float));
    for (std::size_t i = 0; i < padded(size); ++i) EXPECT_EQ(column.data()[i], -3.0f) << i;
  }
}

TEST(Column, GrowingKeepsWhatIsThere) {
  Column<int> column(heap(), 7);
  for (int i = 0; i < 100; ++i) column.push_back(i);
  ASSERT_EQ(column.size(), 100u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(column[static_cast<std::size_t>(i)], i);
  column.resize(120);
  EXPECT_EQ(column[119], 7);
}

TEST(Column, ShrinkingRefillsSoThatThePaddingStaysInert) {
  Column<int> column(heap(), -1);
  column.resize(16);
  std::iota(column.begin(), column.end(), 0);
  column.resize(3);
  EXPECT_EQ(values(column), (std::vector{0, 1, 2}));
  for (std::size_t i = 3; i < 16; ++i) EXPECT_EQ(column.data()[i], -1);
  EXPECT_EQ(column.bytes(), 16 * sizeof(int));
}

TEST(Column, EraseClosesTheGap) {
  Column<int> column(heap(), -1);
  column.resize(6);
  std::iota(column.begin(), column.end(), 0);
  column.erase(1, 2);
  EXPECT_EQ(values(column), (std::vector{0, 3, 4, 5}));
  column.erase(3, 1);
  EXPECT_EQ(values(column), (std::vector{0, 3, 4}));
  column.erase(0, 0);
  column.erase(0, 3);
  EXPECT_EQ(column.size(), 0u);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(column.data()[i], -1);
}

TEST(Column, MovesAndGivesItsMemoryBack) {
  FailingMemory memory(100);
  {
    Column<int> a(&memory), b(&memory);
    a.push_back(1);
    b.push_back(2);
    Column<int> c(std::move(a));
    EXPECT_EQ(values(c), std::vector{1});
    c = std::move(b);
    EXPECT_EQ(values(c), std::vector{2});
    EXPECT_EQ(memory.live(), 2);
  }
  EXPECT_EQ(memory.live(), 0);
}

TEST(Column, IsUnchangedWhenMemoryRunsOut) {
  FailingMemory memory(1);
  Column<int> column(&memory, -1);
  column.resize(16);
  std::iota(column.begin(), column.end(), 0);
  const std::vector<int> before = values(column);
  EXPECT_THROW(column.resize(17), std::bad_alloc);
  EXPECT_THROW(column.push_back(1), std::bad_alloc);
  EXPECT_EQ(values(column), before);
  EXPECT_EQ(memory.live(), 1);
  memory.allow(1);
  column.push_back(16);
  EXPECT_EQ(column.size(), 17u);
  EXPECT_EQ(column[16], 16);
}

TEST(Vec3Column, IsUnchangedWhenMemoryRunsOutBetweenItsAxes) {
  for (int allowed = 3; allowed < 6; ++allowed) {
    FailingMemory memory(allowed);
    Vec3Column column(&memory);
    column.resize(16);
    column.view().set(15, {1, 2, 3});
    EXPECT_THROW(column.resize(17), std::bad_alloc);
    EXPECT_EQ(column.x.size(), 16u);
    EXPECT_EQ(column.y.size(), 16u);
    EXPECT_EQ(column.z.size(), 16u);
    EXPECT_EQ(column.view()[15], (Vec3{1, 2, 3}));
  }
}

TEST(Vec3Column, ViewsReadAndWriteRanges) {
  Vec3Column column(heap());
  column.resize(4);
  column.view().from(2).set(1, {1, 2, 3});
  column.view().add(3, {1, 1, 1});
  EXPECT_EQ(std::as_const(column).view()[3], (Vec3{2, 3, 4}));
  column.erase(0, 3);
  EXPECT_EQ(column.view()[0], (Vec3{2, 3, 4}));
}

}  // namespace
}  // namespace pleat
