#include "systems/box_tree.h"

#include <algorithm>

namespace pleat {
namespace {

template <class Least>
PLEAT_KERNEL float least_of(const Lanes& v, const Least& least) {
  const Lanes of_two = least(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
  const Lanes of_four = least(of_two, __builtin_shufflevector(of_two, of_two, 2, 3, 0, 1, 6, 7, 4, 5));
  return least(of_four, __builtin_shufflevector(of_four, of_four, 1, 0, 3, 2, 5, 4, 7, 6))[0];
}

PLEAT_KERNEL void set(BoxLanes& node, std::size_t lane, const float* six) {
  node.low.x[lane] = six[0], node.low.y[lane] = six[1], node.low.z[lane] = six[2];
  node.high.x[lane] = six[3], node.high.y[lane] = six[4], node.high.z[lane] = six[5];
}

/// The box around all of a node's.
PLEAT_KERNEL void set_around(BoxLanes& node, std::size_t lane, const BoxLanes& child) {
  const auto low = [](const Lanes& a, const Lanes& b) PLEAT_KERNEL_LAMBDA { return min(a, b); };
  const auto high = [](const Lanes& a, const Lanes& b) PLEAT_KERNEL_LAMBDA { return max(a, b); };
  const float six[] = {least_of(child.low.x, low),   least_of(child.low.y, low),   least_of(child.low.z, low),
                       least_of(child.high.x, high), least_of(child.high.y, high), least_of(child.high.z, high)};
  set(node, lane, six);
}

}  // namespace

void BoxTree::build(const std::uint32_t* order, std::size_t count) {
  count_ = count;
  order_.resize((count + kLanes - 1) / kLanes * kLanes);
  std::copy(order, order + count, order_.begin());
  std::fill(order_.begin() + count, order_.end(), order[count - 1]);
  levels_ = 0;
  for (std::size_t n = count; n > 1 || levels_ < 2;) {
    n = (n + kLanes - 1) / kLanes;
    begin_[levels_ + 1] = begin_[levels_] + n;
    ++levels_;
  }
  nodes_.resize(begin_[levels_]);
  std::fill(nodes_.begin(), nodes_.end(), BoxLanes{});
}

void BoxTree::fit_around_leaves() {
  BoxLanes& last = nodes_[begin_[1] - 1];
  const BoxLanes empty;
  for (std::size_t lane = count_ - kLanes * (begin_[1] - 1); lane < kLanes; ++lane) set_around(last, lane, empty);
  run_wide(widest_vectors(), [&] {
    for (std::size_t level = 1; level < levels_; ++level) {
      const std::size_t count = begin_[level] - begin_[level - 1];
      for (std::size_t i = 0; i < count; ++i) {
        set_around(nodes_[begin_[level] + i / kLanes], i % kLanes, nodes_[begin_[level - 1] + i]);
      }
    }
  });
}

Box BoxTree::bounds() const {
  const BoxLanes& root = nodes_[begin_[levels_ - 1]];
  Box box;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Vec3 low{root.low.x[lane], root.low.y[lane], root.low.z[lane]};
    const Vec3 high{root.high.x[lane], root.high.y[lane], root.high.z[lane]};
    if (!(low.x <= high.x)) continue;  // empty
    box.include(low);
    box.include(high);
  }
  return box;
}

}  // namespace pleat
