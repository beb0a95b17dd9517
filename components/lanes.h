// Eight floats that a kernel works on at once, and as an element of Vec3T eight vectors. Arithmetic and comparison are
// the compiler's own, lane by lane: the bits do not depend on how wide the processor is. `mask ? a : b` chooses by
// lane.
#pragma once

#include <cstdint>
#include <cstring>

#include "components/column.h"

namespace pleat {

inline constexpr std::uint32_t kLanes = 8;

using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneMask = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));  // -1 or 0
using Vec3Lanes = Vec3T<Lanes>;

inline Lanes min(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
inline Lanes max(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
inline Lanes abs(const Lanes& a) { return a < 0.0f ? -a : a; }
inline Lanes clamped(const Lanes& t) { return min(max(t, Lanes{}), Lanes{} + 1.0f); }
inline Lanes sqrt(const Lanes& a) {
  Lanes root;
  for (std::size_t k = 0; k < kLanes; ++k) root[k] = std::sqrt(a[k]);
  return root;
}
inline bool any(const LaneMask& mask) {
  std::uint64_t pairs[kLanes / 2];
  std::memcpy(pairs, &mask, sizeof pairs);
  return (pairs[0] | pairs[1] | pairs[2] | pairs[3]) != 0;
}

inline float largest(const Lanes& a) {
  float found = a[0];
  for (std::size_t k = 1; k < kLanes; ++k) found = a[k] > found ? a[k] : found;
  return found;
}

inline Lanes all(float value) { return Lanes{} + value; }
inline Vec3Lanes all(const Vec3& v) { return {all(v.x), all(v.y), all(v.z)}; }

/// Neighbours in a column, which ends on whole lanes.
inline Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline Vec3Lanes load(ConstVec3View from, std::size_t begin) {
  return {load(from.x + begin), load(from.y + begin), load(from.z + begin)};
}
inline void store(const Lanes& lanes, float* to) { std::memcpy(to, &lanes, sizeof lanes); }
inline void store(const Vec3Lanes& lanes, const Vec3View& to, std::size_t begin) {
  store(lanes.x, to.x + begin), store(lanes.y, to.y + begin), store(lanes.z, to.z + begin);
}

/// The largest value(lanes from i on) of count, or 0; lanes from `count` on do not count.
template <class Value>
inline float largest(std::size_t count, const Value& value) {
  constexpr Lanes kPlace{0, 1, 2, 3, 4, 5, 6, 7};
  Lanes most{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) most = max(value(i), most);
  if (i < count) most = max(kPlace < static_cast<float>(count - i) ? value(i) : Lanes{}, most);
  return largest(most);
}

/// from[index[0]], from[index[1]], ...
inline Lanes gather(const float* from, const std::uint32_t* index) {
  return Lanes{from[index[0]], from[index[1]], from[index[2]], from[index[3]],
               from[index[4]], from[index[5]], from[index[6]], from[index[7]]};
}
inline Vec3Lanes gather(ConstVec3View from, const std::uint32_t* index) {
  return {gather(from.x, index), gather(from.y, index), gather(from.z, index)};
}

/// A bit a lane, the first lane's lowest.
inline std::uint8_t bits(const LaneMask& mask) {
  const LaneMask places = mask & LaneMask{1, 2, 4, 8, 16, 32, 64, 128};
  std::int32_t sum = 0;
  for (std::size_t k = 0; k < kLanes; ++k) sum |= places[k];
  return static_cast<std::uint8_t>(sum);
}

}  // namespace pleat
