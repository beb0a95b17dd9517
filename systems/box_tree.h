// Boxes in a tree whose nodes hold eight: one question asks eight at a time.
#pragma once

#include <bit>
#include <cstddef>

#include "components/column.h"
#include "components/lanes.h"
#include "systems/box.h"

namespace pleat {

/// Eight boxes. A new one holds empty ones.
struct BoxLanes {
  Vec3Lanes low{all({1e30f, 1e30f, 1e30f})}, high{all({-1e30f, -1e30f, -1e30f})};  // m

  PLEAT_KERNEL BoxLanes with(const BoxLanes& b) const {
    return {{min(low.x, b.low.x), min(low.y, b.low.y), min(low.z, b.low.z)},
            {max(high.x, b.high.x), max(high.y, b.high.y), max(high.z, b.high.z)}};
  }
  PLEAT_KERNEL BoxLanes moved(const Vec3Lanes& by) const { return {low + by, high + by}; }
  PLEAT_KERNEL BoxLanes grown(const Lanes& by) const {
    return {{low.x - by, low.y - by, low.z - by}, {high.x + by, high.y + by, high.z + by}};
  }
  PLEAT_KERNEL LaneMask overlaps(const BoxLanes& b) const {
    return (low.x <= b.high.x) & (b.low.x <= high.x) & (low.y <= b.high.y) & (b.low.y <= high.y) & (low.z <= b.high.z) &
           (b.low.z <= high.z);
  }
};

/// Items keep their leaves: neighbours in the order given at the start share nodes.
class BoxTree {
 public:
  explicit BoxTree(std::pmr::memory_resource* memory) : order_(memory), nodes_(memory) {}

  /// order: of items, each once; at most 8^kMostLevels.
  void build(const std::uint32_t* order, std::size_t count);
  /// boxes_of(items): a kernel, the boxes of a leaf's eight, m.
  template <class BoxesOf>
  void refit(const BoxesOf& boxes_of) {
    run_wide(widest_vectors(), [&] {
      for (std::uint32_t leaf = 0; leaf < begin_[1]; ++leaf) nodes_[leaf] = boxes_of(items(leaf));
    });
    fit_around_leaves();
  }
  /// Around all items.
  Box bounds() const;

  /// visit(leaf, items) for those whose boxes and all around them are near, in the order given at the start: a bit for
  /// each of the leaf's items. near(boxes): a mask, which does not count where a node is not full.
  template <class Near, class Visit>
  PLEAT_KERNEL void for_each(const Near& near, const Visit& visit) const {
    std::uint32_t node[kMostLevels], rest[kMostLevels];
    const auto enter = [&](std::size_t level, std::uint32_t n) PLEAT_KERNEL_LAMBDA {
      node[level] = n, rest[level] = bits(near(nodes_[begin_[level] + n])) & filled(level, n);
    };
    std::size_t level = levels_ - 1;
    for (enter(level, 0); level < levels_;) {
      if (rest[level] == 0) {
        ++level;
        continue;
      }
      const std::uint32_t child = kLanes * node[level] + static_cast<std::uint32_t>(std::countr_zero(rest[level]));
      rest[level] &= rest[level] - 1;
      enter(--level, child);
      if (level != 0) continue;
      if (rest[0] != 0) visit(child, rest[0]);
      rest[0] = 0;
    }
  }
  /// kLanes of them; what the last leaf leaves empty repeats its last one.
  const std::uint32_t* items(std::uint32_t leaf) const { return order_.data() + std::size_t{leaf} * kLanes; }

 private:
  void fit_around_leaves();
  /// A bit for each of a node's eight that there is.
  PLEAT_KERNEL std::uint32_t filled(std::size_t level, std::uint32_t n) const {
    const std::size_t below = level == 0 ? count_ : begin_[level] - begin_[level - 1], rest = below - kLanes * n;
    return rest < kLanes ? (1u << rest) - 1 : 0xffu;
  }

  static constexpr std::size_t kMostLevels = 8;
  Column<std::uint32_t> order_;                                    // of the items in the leaves
  Column<BoxLanes> nodes_;                                         // those that hold items first, the root last
  std::size_t count_ = 0, begin_[kMostLevels + 1]{}, levels_ = 0;  // at least two levels
};

}  // namespace pleat
