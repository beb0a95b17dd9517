// Points filed in the cells of a regular grid around them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "components/garment.h"
#include "components/near_pairs.h"
#include "systems/box.h"

namespace pleat {

/// Points by their cells, x running fastest, so that the points of a row of cells lie together. Cells are as large as
/// asked for, or larger where that would make more than two for each point.
class PointGrid {
 public:
  /// cell_size: m. The scratch stays in use.
  PointGrid(ConstVec3View points, std::uint32_t count, float cell_size, GridScratch& scratch)
      : box_(box_of(points, count)),
        begin_(scratch.begin.data()),
        filed_(scratch.filed.data()),
        near_(scratch.near.data()),
        point_(scratch.point.data()) {
    const Vec3 extent = box_.high - box_.low;
    const auto cells_along = [&](int axis) {
      return 1.0 + double{std::min(at(extent, axis), kFarthest)} * double{inverse_size_};
    };
    for (cell_size = std::max(kLeastCell, cell_size);; cell_size *= 1.25f) {
      inverse_size_ = 1.0f / cell_size;
      const double cells = cells_along(0) * cells_along(1) * cells_along(2);
      if (cells <= 2.0 * count + 1.0) break;
    }
    for (int axis = 0; axis < 3; ++axis) cells_[axis] = static_cast<std::int32_t>(cells_along(axis));
    const std::int32_t cell_count = cells_[0] * cells_[1] * cells_[2];
    std::fill(begin_, begin_ + cell_count + 1, 0u);
    std::uint32_t* cell_of = near_;
    for (std::uint32_t i = 0; i < count; ++i) ++begin_[cell_of[i] = cell(points[i])];
    for (std::int32_t c = 0; c < cell_count; ++c) begin_[c + 1] += begin_[c];
    for (std::uint32_t i = count; i-- > 0;) {
      const std::uint32_t at = --begin_[cell_of[i]];
      filed_[at] = i;
      point_[at] = {points[i].x, points[i].y, points[i].z, 0.0f};
    }
  }

  /// Which point is at a place, and all of them in their order.
  std::uint32_t filed(std::uint32_t place) const { return filed_[place]; }
  const Vec4* points() const { return point_; }

  /// visit(index) for every point in the box, and for some around it.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const {
    for_each_row_near(box, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t place = begin; place < end; ++place) visit(filed_[place]);
    });
  }

  /// The places of the same points, those below `before` only, in whole lanes: the last ones are filled up with place
  /// 0.
  struct Places {
    const std::uint32_t* place;
    std::uint32_t count;

    /// found(place) for those whose bits test(eight places) sets.
    template <class Test, class Found>
    PLEAT_KERNEL void for_each_of(const Test& test, const Found& found) const {
      for (std::uint32_t i = 0; i < count; i += kLanes) {
        std::uint32_t left = test(place + i) & ((1u << std::min(count - i, kLanes)) - 1);
        for (; left != 0; left &= left - 1) found(place[i + static_cast<std::uint32_t>(std::countr_zero(left))]);
      }
    }
  };
  PLEAT_KERNEL Places near(const Box& box, std::uint32_t before = kNone) const {
    std::uint32_t* const to = near_;
    const std::uint32_t* const filed = filed_;
    std::uint32_t count = 0;
    for_each_row_near(box, [&](std::uint32_t begin, std::uint32_t end) PLEAT_KERNEL_LAMBDA {
      if (before == kNone) {
        for (std::uint32_t place = begin; place < end; place += kLanes) {
          const LaneMask eight = LaneMask{0, 1, 2, 3, 4, 5, 6, 7} + static_cast<std::int32_t>(place);
          std::memcpy(to + count + (place - begin), &eight, sizeof eight);
        }
        count += end - begin;
        return;
      }
      for (std::uint32_t place = begin; place < end; ++place) {
        to[count] = place;
        count += filed[place] < before ? 1 : 0;
      }
    });
    std::fill_n(near_ + count, kLanes, 0u);
    return {near_, count};
  }

 private:
  /// row(begin, end) for places.
  template <class Row>
  PLEAT_KERNEL void for_each_row_near(const Box& box, const Row& row) const {
    std::int32_t from[3], to[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float low = along(box.low, axis), high = along(box.high, axis);
      if (!(high >= 0.0f && low <= static_cast<float>(cells_[axis]))) return;
      from[axis] = cell_at(low, axis);
      to[axis] = cell_at(high, axis);
    }
    for (std::int32_t z = from[2]; z <= to[2]; ++z) {
      for (std::int32_t y = from[1]; y <= to[1]; ++y) {
        const std::int32_t first = (z * cells_[1] + y) * cells_[0];
        row(begin_[first + from[0]], begin_[first + to[0] + 1]);
      }
    }
  }

  static float at(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
  /// In cells from the first on.
  float along(const Vec3& p, int axis) const { return (at(p, axis) - at(box_.low, axis)) * inverse_size_; }
  /// Points that are not finite are filed too, anywhere.
  std::int32_t cell_at(float along, int axis) const {
    const std::int32_t last = cells_[axis] - 1;
    return !(along > 0.0f) ? 0 : along < static_cast<float>(last) ? static_cast<std::int32_t>(along) : last;
  }
  std::uint32_t cell(const Vec3& p) const {
    const std::int32_t y = cell_at(along(p, 1), 1), z = cell_at(along(p, 2), 2);
    return static_cast<std::uint32_t>((z * cells_[1] + y) * cells_[0] + cell_at(along(p, 0), 0));
  }

  static constexpr float kFarthest = 1e9f, kLeastCell = 1e-6f;  // m

  Box box_;
  float inverse_size_ = 1.0f;
  std::int32_t cells_[3];
  std::uint32_t* begin_;  // (cells + 1)
  std::uint32_t* filed_;  // (count)
  std::uint32_t* near_;   // (count + kLanes)
  Vec4* point_;           // (count) in the order of filed_
};

}  // namespace pleat
