#include "components/lanes.h"

#include <gtest/gtest.h>

#include <memory_resource>
#include <vector>

#include "components/lane_rows.h"

namespace pleat {
namespace {

constexpr Lanes kCounting{0, 1, 2, 3, 4, 5, 6, 7};

/// Of particle i: (i, 100 + i, 200 + i).
Vec3Column numbered(std::size_t count) {
  Vec3Column column(std::pmr::new_delete_resource());
  column.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    column.view().set(i, {x, 100.0f + x, 200.0f + x});
  }
  return column;
}

TEST(Lanes, BitsAreTheLanesInOrder) {
  EXPECT_EQ(bits(kCounting < 3.0f), 0b00000111u);
  EXPECT_EQ(bits((kCounting == 0.0f) | (kCounting == 7.0f)), 0b10000001u);
  EXPECT_FALSE(any(kCounting > 7.0f));
  EXPECT_TRUE(any(kCounting > 6.0f));
}

TEST(Lanes, LargestLeavesOutWhatIsBeyondTheCount) {
  for (std::size_t count = 0; count <= 20; ++count) {
    const float expected = count == 0 ? 0.0f : static_cast<float>(count - 1);
    EXPECT_EQ(largest(count, [](std::size_t i) { return kCounting + static_cast<float>(i); }), expected) << count;
  }
  EXPECT_EQ(largest(-kCounting), 0.0f);
}

TEST(Lanes, TransposeTwiceIsNothing) {
  const Lanes before[4] = {kCounting, kCounting + 10.0f, kCounting + 20.0f, kCounting + 30.0f};
  Lanes once[4], twice[4];
  transpose(before, once);
  transpose(once, twice);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(bits(twice[k] == before[k]), 0xffu) << k;
  EXPECT_EQ(once[2][1], before[1][2]);  // a square of four in each half
  EXPECT_EQ(once[2][5], before[1][6]);
}

TEST(Lanes, PackedVectorsComeBackInAnyOrder) {
  constexpr std::size_t kCount = 21;
  const Vec3Column from = numbered(kCount);
  Column<float> w(std::pmr::new_delete_resource());
  Column<Vec4> packed(std::pmr::new_delete_resource());
  w.resize(kCount), packed.resize(kCount);
  for (std::size_t i = 0; i < kCount; ++i) w[i] = 300.0f + static_cast<float>(i);
  pack(from.view(), w.data(), kCount, packed.data());
  const std::uint32_t index[kLanes] = {20, 3, 3, 0, 17, 8, 7, 19};
  const Vec4Lanes found = gather(packed.data(), index);
  const Vec3Lanes columns = gather(from.view(), index);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto x = static_cast<float>(index[k]);
    EXPECT_EQ(found.vector.x[k], x);
    EXPECT_EQ(found.vector.y[k], 100.0f + x);
    EXPECT_EQ(found.vector.z[k], 200.0f + x);
    EXPECT_EQ(found.w[k], 300.0f + x);
    EXPECT_EQ(columns.z[k], 200.0f + x);
  }
  Vec3Column back = numbered(0);
  back.resize(kCount);
  unpack(packed.data(), kCount, back.view());
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(back.view()[i], from.view()[i]) << i;
}

TEST(Lanes, ScatteredLanesOfOneParticleAddUp) {
  std::vector<Vec4> sums(4, Vec4{1, 1, 1, 1});
  const std::uint32_t index[kLanes] = {0, 1, 1, 3, 1, 0, 2, 2};
  scatter_add({kCounting, 2.0f * kCounting, -kCounting}, index, kLanes, sums.data());
  EXPECT_EQ(sums[0].x, 1.0f + 0.0f + 5.0f);
  EXPECT_EQ(sums[1].y, 1.0f + 2.0f * (1.0f + 2.0f + 4.0f));
  EXPECT_EQ(sums[2].z, 1.0f - (6.0f + 7.0f));
  EXPECT_EQ(sums[3].w, 1.0f);
  scatter_add({kCounting, kCounting, kCounting}, index, 2, sums.data());  // of the rest nothing
  EXPECT_EQ(sums[1].x, 1.0f + 7.0f + 1.0f);
  EXPECT_EQ(sums[3].x, 1.0f + 3.0f);
}

TEST(Lanes, ArithmeticOfALaneIsThatOfAFloat) {
  const Lanes root = sqrt(kCounting), limited = clamped(0.3f * kCounting - 0.5f);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float x = kCounting[k];
    EXPECT_EQ(root[k], std::sqrt(x));
    EXPECT_EQ(limited[k], std::min(std::max(0.3f * x - 0.5f, 0.0f), 1.0f));
  }
}

TEST(LaneRows, StoresEachLaneAsItsRowAndNothingBehind) {
  for (std::uint32_t length = 1; length <= 9; ++length) {
    for (std::uint32_t count = 1; count <= kLanes; ++count) {
      LaneRows rows;
      for (std::uint32_t i = 0; i < length; ++i) {
        const float place = 100.0f * static_cast<float>(i);
        const Lanes lane{0, 1, 2, 3, 4, 5, 6, 7};
        rows.set(i, {lane + place, lane + place + 0.25f, lane + place + 0.5f});
      }
      std::vector<float> x(2 + length * kLanes + 4, -1.0f), y = x, z = x;
      rows.store_to({x.data(), y.data(), z.data()}, 2, length, count);
      for (std::uint32_t j = 0; j < x.size(); ++j) {
        const std::uint32_t k = (j - 2) / length, i = (j - 2) % length;
        const bool inside = j >= 2 && k < count;
        const float expected = 100.0f * static_cast<float>(i) + static_cast<float>(k);
        EXPECT_EQ(x[j], inside ? expected : -1.0f);
        EXPECT_EQ(y[j], inside ? expected + 0.25f : -1.0f);
        EXPECT_EQ(z[j], inside ? expected + 0.5f : -1.0f);
      }
    }
  }
}

}  // namespace
}  // namespace pleat
