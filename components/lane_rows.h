// Columns of which eight edges or faces each own a row: a few neighbouring elements, the rows one behind the other.
#pragma once

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {

/// Points of eight edges or faces, those of the same place in their rows side by side, until they are stored.
struct LaneRows {
  static constexpr std::uint32_t kMostPlaces = 108;  // of a row
  alignas(Lanes) float x[kMostPlaces * kLanes], y[kMostPlaces * kLanes], z[kMostPlaces * kLanes];

  PLEAT_KERNEL void set(std::uint32_t place, const Vec3Lanes& point) { store(point, {x, y, z}, place * kLanes); }
  /// The first `count` rows of `length` places; the first of them begins at to[begin].
  PLEAT_KERNEL void store_to(const Vec3View& to, std::size_t begin, std::uint32_t length, std::uint32_t count) const {
    store_to(to.x + begin, x, length, count);
    store_to(to.y + begin, y, length, count);
    store_to(to.z + begin, z, length, count);
  }

 private:
  static PLEAT_KERNEL void store_to(float* to, const float* from, std::uint32_t length, std::uint32_t count) {
    using FourAnywhere = float __attribute__((vector_size(4 * sizeof(float)), aligned(4), may_alias));
    if (count == kLanes && length % 4 == 0) {
      for (std::uint32_t i = 0; i < length; i += 4, from += 4 * kLanes) {
        Four row[kLanes];
        split({load(from), load(from + kLanes), load(from + 2 * kLanes)}, load(from + 3 * kLanes), row);
        for (std::uint32_t k = 0; k < kLanes; ++k) reinterpret_cast<FourAnywhere&>(to[k * length + i]) = row[k];
      }
    } else if (count == kLanes && length == 3) {  // what is put behind a row is the next one's place
      Four row[kLanes];
      split({load(from), load(from + kLanes), load(from + 2 * kLanes)}, Lanes{}, row);
      for (std::uint32_t k = 0; k + 1 < kLanes; ++k) reinterpret_cast<FourAnywhere&>(to[k * 3]) = row[k];
      for (std::uint32_t j = 0; j < 3; ++j) to[(kLanes - 1) * 3 + j] = row[kLanes - 1][j];
    } else {
      for (std::uint32_t k = 0; k < count; ++k) {
        for (std::uint32_t i = 0; i < length; ++i) to[k * length + i] = from[i * kLanes + k];
      }
    }
  }
};

}  // namespace pleat
