#include "systems/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory_resource>
#include <random>
#include <vector>

#include "systems/box.h"

namespace pleat {
namespace {

struct Filed {
  std::vector<std::uint32_t> order;
  std::vector<float> boxes;
  BoxTree tree{std::pmr::new_delete_resource()};

  Filed(std::uint32_t count, std::mt19937& random) : order(count), boxes(6 * std::size_t{count}) {
    for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    tree.build(order.data(), count);
    move(random);
  }
  void move(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-1.0f, 1.0f), size(0.0f, 0.2f);
    for (std::size_t i = 0; i < boxes.size(); i += 6) {
      for (std::size_t k = 0; k < 3; ++k) {
        boxes[i + k] = place(random);
        boxes[i + 3 + k] = boxes[i + k] + size(random);
      }
    }
    tree.refit([&](const std::uint32_t* items) PLEAT_KERNEL_LAMBDA {
      BoxLanes leaf;
      for (std::size_t k = 0; k < kLanes; ++k) {
        const Box b = box(items[k]);
        leaf.low.x[k] = b.low.x, leaf.low.y[k] = b.low.y, leaf.low.z[k] = b.low.z;
        leaf.high.x[k] = b.high.x, leaf.high.y[k] = b.high.y, leaf.high.z[k] = b.high.z;
      }
      return leaf;
    });
    Box whole;
    for (std::uint32_t i = 0; i < order.size(); ++i) whole.include(box(i).low), whole.include(box(i).high);
    EXPECT_EQ(tree.bounds().low, whole.low);
    EXPECT_EQ(tree.bounds().high, whole.high);
  }
  Box box(std::uint32_t item) const {
    const float* b = boxes.data() + 6 * std::size_t{item};
    return {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
  }
  std::vector<std::uint32_t> expected(const Box& asked) const {
    std::vector<std::uint32_t> found;
    std::copy_if(order.begin(), order.end(), std::back_inserter(found),
                 [&](std::uint32_t item) { return box(item).overlaps(asked); });
    return found;
  }
  std::vector<std::uint32_t> found(const Box& asked) const {
    std::vector<std::uint32_t> items;
    const BoxLanes around{all(asked.low), all(asked.high)};
    const auto near = [&](const BoxLanes& boxes_of_node) PLEAT_KERNEL_LAMBDA { return boxes_of_node.overlaps(around); };
    tree.for_each(near, [&](std::uint32_t leaf, std::uint32_t some) PLEAT_KERNEL_LAMBDA {
      for (std::uint32_t k = 0; k < kLanes; ++k) {
        if ((some >> k & 1) != 0) items.push_back(tree.items(leaf)[k]);
      }
    });
    return items;
  }
};

TEST(BoxTree, PropertyFindsWhatOverlapsOnceAndInOrderAlsoAfterMoves) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-1.2f, 1.2f), size(0.5f, 2.0f);
  for (const std::uint32_t count : {1u, 7u, 8u, 9u, 64u, 65u, 512u, 513u, 5000u}) {
    Filed filed(count, random);
    std::size_t hits = 0;
    for (int n = 0; n < 60; ++n) {
      if (n == 30) filed.move(random);
      const Vec3 low{place(random), place(random), place(random)};
      const Box asked{low, low + Vec3{size(random), size(random), size(random)}};
      const std::vector<std::uint32_t> found = filed.found(asked);
      ASSERT_EQ(found, filed.expected(asked)) << count;
      hits += found.size();
    }
    EXPECT_GT(hits, count) << count;
    for (const float far : {9.0f, 1e30f, std::numeric_limits<float>::infinity()}) {
      EXPECT_EQ(filed.found({{-far, -far, -far}, {far, far, far}}), filed.order) << far;
    }
  }
}

}  // namespace
}  // namespace pleat
