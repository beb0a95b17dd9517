// Eight floats that a kernel works on at once, and as an element of Vec3T eight vectors. Arithmetic and comparison are
// the compiler's own, lane by lane: the bits do not depend on how wide the processor is. `mask ? a : b` chooses by
// lane. All of it is inlined: a call from a kernel compiled for wider vectors would pass lanes in other registers.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

inline constexpr std::uint32_t kLanes = 8;

using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneMask = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));  // -1 or 0
using Vec3Lanes = Vec3T<Lanes>;
using Four = float __attribute__((vector_size(4 * sizeof(float))));

PLEAT_KERNEL Lanes min(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
PLEAT_KERNEL Lanes max(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
PLEAT_KERNEL Lanes abs(const Lanes& a) { return a < 0.0f ? -a : a; }
PLEAT_KERNEL Lanes clamped(const Lanes& t) { return min(max(t, Lanes{}), Lanes{} + 1.0f); }
PLEAT_KERNEL Lanes sqrt(const Lanes& a) {
  Lanes root;
  for (std::size_t k = 0; k < kLanes; ++k) root[k] = std::sqrt(a[k]);
  return root;
}
/// The same of one float, so that a kernel's source can be for both.
constexpr float min(float a, float b) { return a < b ? a : b; }
constexpr float max(float a, float b) { return a > b ? a : b; }
PLEAT_KERNEL float sqrt(float a) { return std::sqrt(a); }

PLEAT_KERNEL Lanes length(const Vec3Lanes& a) { return sqrt(dot(a, a)); }

/// A bit a lane, the first lane's lowest.
PLEAT_KERNEL std::uint8_t bits(const LaneMask& mask) {
#ifdef __SSE__
  Four halves[2];
  std::memcpy(halves, &mask, sizeof halves);
  return static_cast<std::uint8_t>(__builtin_ia32_movmskps(halves[0]) | __builtin_ia32_movmskps(halves[1]) << 4);
#else
  const LaneMask places = mask & LaneMask{1, 2, 4, 8, 16, 32, 64, 128};
  std::int32_t sum = 0;
  for (std::size_t k = 0; k < kLanes; ++k) sum |= places[k];
  return static_cast<std::uint8_t>(sum);
#endif
}
PLEAT_KERNEL bool any(const LaneMask& mask) {
#ifdef __SSE__
  Four halves[2];
  std::memcpy(halves, &mask, sizeof halves);
  return (__builtin_ia32_movmskps(halves[0]) | __builtin_ia32_movmskps(halves[1])) != 0;
#else
  return bits(mask) != 0;
#endif
}
/// How many lanes of a mask are set.
PLEAT_KERNEL std::uint32_t count(const LaneMask& mask) { return static_cast<std::uint32_t>(std::popcount(bits(mask))); }
/// The same of one, so that a kernel's source can be for both.
PLEAT_KERNEL bool any(bool mask) { return mask; }
PLEAT_KERNEL std::uint32_t count(bool mask) { return mask ? 1 : 0; }

PLEAT_KERNEL float largest(const Lanes& a) {
  float found = a[0];
  for (std::size_t k = 1; k < kLanes; ++k) found = a[k] > found ? a[k] : found;
  return found;
}

PLEAT_KERNEL Lanes all(float value) { return Lanes{} + value; }
PLEAT_KERNEL Vec3Lanes all(const Vec3& v) { return {all(v.x), all(v.y), all(v.z)}; }

PLEAT_KERNEL Vec3 choose(bool mask, const Vec3& a, const Vec3& b) { return mask ? a : b; }
PLEAT_KERNEL Vec3Lanes choose(const LaneMask& mask, const Vec3Lanes& a, const Vec3Lanes& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}
/// Unit vectors, or `otherwise` where they are too short to have a direction.
PLEAT_KERNEL Vec3Lanes normalized_or(const Vec3Lanes& a, const Vec3Lanes& otherwise) {
  const Lanes l = length(a);
  const LaneMask good = l > 1e-12f;
  return choose(good, a * (1.0f / (good ? l : all(1.0f))), otherwise);
}

/// Neighbours in a column, which ends on whole lanes.
PLEAT_KERNEL Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
PLEAT_KERNEL Vec3Lanes load(ConstVec3View from, std::size_t begin) {
  return {load(from.x + begin), load(from.y + begin), load(from.z + begin)};
}
PLEAT_KERNEL void store(const Lanes& lanes, float* to) { std::memcpy(to, &lanes, sizeof lanes); }
PLEAT_KERNEL void store(const Vec3Lanes& lanes, const Vec3View& to, std::size_t begin) {
  store(lanes.x, to.x + begin), store(lanes.y, to.y + begin), store(lanes.z, to.z + begin);
}
/// The first `count` of them, where what comes next is somebody else's.
PLEAT_KERNEL void store(const Lanes& lanes, float* to, std::uint32_t count) {
  if (count >= kLanes) return store(lanes, to);
  for (std::uint32_t k = 0; k < count; ++k) to[k] = lanes[k];
}
PLEAT_KERNEL void store(const Vec3Lanes& lanes, const Vec3View& to, std::size_t begin, std::uint32_t count) {
  store(lanes.x, to.x + begin, count), store(lanes.y, to.y + begin, count), store(lanes.z, to.z + begin, count);
}

/// The first `count` of them.
PLEAT_KERNEL LaneMask first_lanes(std::size_t count) {
  constexpr Lanes kPlace{0, 1, 2, 3, 4, 5, 6, 7};
  return kPlace < static_cast<float>(count);
}

/// The largest value(lanes from i on) of count, or 0; lanes from `count` on do not count.
template <class Value>
PLEAT_KERNEL float largest(std::size_t count, const Value& value) {
  Lanes most{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) most = max(value(i), most);
  if (i < count) most = max(first_lanes(count - i) ? value(i) : Lanes{}, most);
  return largest(most);
}

/// from[index[0]], from[index[1]], ...
PLEAT_KERNEL Lanes gather(const float* from, const std::uint32_t* index) {
  return Lanes{from[index[0]], from[index[1]], from[index[2]], from[index[3]],
               from[index[4]], from[index[5]], from[index[6]], from[index[7]]};
}
PLEAT_KERNEL Vec3Lanes gather(ConstVec3View from, const std::uint32_t* index) {
  return {gather(from.x, index), gather(from.y, index), gather(from.z, index)};
}

/// to[index[k]] += lane k, one after the other, for the first `count` lanes.
PLEAT_KERNEL void scatter_add(const Lanes& lanes, const std::uint32_t* index, std::uint32_t count, float* to) {
  for (std::uint32_t k = 0; k < count; ++k) to[index[k]] += lanes[k];
}
PLEAT_KERNEL void scatter_add(const Vec3Lanes& lanes, const std::uint32_t* index, std::uint32_t count,
                              const Vec3View& to) {
  for (std::uint32_t k = 0; k < count; ++k) to.add(index[k], {lanes.x[k], lanes.y[k], lanes.z[k]});
}

/// Four lanes of four floats each, beside each other, become four times the same place of all.
PLEAT_KERNEL void transpose(const Lanes (&pairs)[4], Lanes (&places)[4]) {
  const Lanes low01 = __builtin_shufflevector(pairs[0], pairs[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes low23 = __builtin_shufflevector(pairs[2], pairs[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes high01 = __builtin_shufflevector(pairs[0], pairs[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes high23 = __builtin_shufflevector(pairs[2], pairs[3], 2, 10, 3, 11, 6, 14, 7, 15);
  places[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
  places[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
  places[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
  places[3] = __builtin_shufflevector(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15);
}

using FourInMemory = float __attribute__((vector_size(4 * sizeof(float)), may_alias));

/// By value, not by memcpy: after that compilers go through the stack for a single number of the four.
PLEAT_KERNEL Four load_four(const Vec4& from) { return reinterpret_cast<const FourInMemory&>(from); }
/// Two beside each other: as integers, for of vectors of four floats GCC 12 makes one more instruction. Clang, which
/// loads integers in pieces, makes of the vectors what it should.
PLEAT_KERNEL Lanes load_pair(const Vec4& low, const Vec4& high) {
#if defined(__SIZEOF_INT128__) && !defined(__clang__)
  __extension__ typedef __int128 Bits __attribute__((may_alias));
  __extension__ typedef __int128 TwoBits __attribute__((vector_size(32)));
  const TwoBits two = {reinterpret_cast<const Bits&>(low), reinterpret_cast<const Bits&>(high)};
  return reinterpret_cast<Lanes>(two);
#else
  return __builtin_shufflevector(load_four(low), load_four(high), 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}
PLEAT_KERNEL void store(Four four, Vec4& to) { reinterpret_cast<FourInMemory&>(to) = four; }

/// Eight vectors, and what each carries besides, each with its components beside each other.
PLEAT_KERNEL void split(const Vec3Lanes& vector, const Lanes& w, Four (&each)[kLanes]) {
  const Lanes places[4] = {vector.x, vector.y, vector.z, w};
  Lanes pairs[4];
  transpose(places, pairs);
  for (std::size_t k = 0; k < 4; ++k) {
    Four halves[2];  // not by shuffles, for the same reason
    std::memcpy(halves, &pairs[k], sizeof halves);
    each[k] = halves[0], each[k + 4] = halves[1];
  }
}
PLEAT_KERNEL void pack(const Vec3Lanes& vector, const Lanes& w, Vec4* to) {
  Four each[kLanes];
  split(vector, w, each);
  for (std::size_t k = 0; k < kLanes; ++k) store(each[k], to[k]);
}
/// Eight vectors and what each carries besides.
struct Vec4Lanes {
  Vec3Lanes vector;
  Lanes w;
};

/// As pack left them.
PLEAT_KERNEL Vec4Lanes load(const Vec4* from) {
  Lanes pairs[4], places[4];
  for (std::size_t k = 0; k < 4; ++k) pairs[k] = load_pair(from[k], from[k + 4]);
  transpose(pairs, places);
  return {{places[0], places[1], places[2]}, places[3]};
}
/// Columns as vectors with their components beside each other. Whole lanes: reads and writes into the padding of all.
PLEAT_KERNEL void pack(ConstVec3View from, const float* w, std::size_t count, Vec4* to) {
  for (std::size_t i = 0; i < count; i += kLanes) pack(load(from, i), w == nullptr ? Lanes{} : load(w + i), to + i);
}
PLEAT_KERNEL void unpack(const Vec4* from, std::size_t count, const Vec3View& to) {
  for (std::size_t i = 0; i < count; i += kLanes) store(load(from + i).vector, to, i);
}

/// What forces on edges and hinges read and add to, as vectors; unpack(packed.force) brings them back.
PLEAT_KERNEL void pack_state(ConstVec3View position, const float* inverse_mass, ConstVec3View velocity,
                             ConstVec3View force, std::size_t count, Vec4Columns& packed) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    Four x[kLanes], v[kLanes];
    split(load(position, i), load(inverse_mass + i), x);
    split(load(velocity, i), Lanes{}, v);
    Motion* to = packed.motion.data() + i;
    for (std::size_t k = 0; k < kLanes; ++k) store(x[k], to[k].position), store(v[k], to[k].velocity);
  }
  pack(force, nullptr, count, packed.force.data());
}

/// from[index[0]], from[index[1]], ...: a load for each, where three columns need three. Index: std::uint32_t, or
/// Vec4Place.
template <class Index>
PLEAT_KERNEL Vec4Lanes gather(const Vec4* from, const Index* index) {
  Lanes pairs[4], places[4];
  for (std::size_t k = 0; k < 4; ++k) pairs[k] = load_pair(at(from, index[k]), at(from, index[k + 4]));
  transpose(pairs, places);
  return {{places[0], places[1], places[2]}, places[3]};
}

struct MotionLanes {
  Vec3Lanes position, velocity;
  Lanes inverse_mass;
};

using LanesInMemory = float __attribute__((vector_size(kLanes * sizeof(float)), may_alias));

/// from[index[0]], from[index[1]], ...
PLEAT_KERNEL MotionLanes gather(const Motion* from, const std::uint32_t* index) {
  Lanes motions[2][4], low[4], high[4];  // of the first four and of the last
  for (std::size_t k = 0; k < kLanes; ++k) {
    motions[k / 4][k % 4] = reinterpret_cast<const LanesInMemory&>(from[index[k]]);
  }
  transpose(motions[0], low), transpose(motions[1], high);
  Lanes x[4], v[3];
  for (std::size_t k = 0; k < 4; ++k) x[k] = __builtin_shufflevector(low[k], high[k], 0, 1, 2, 3, 8, 9, 10, 11);
  for (std::size_t k = 0; k < 3; ++k) v[k] = __builtin_shufflevector(low[k], high[k], 4, 5, 6, 7, 12, 13, 14, 15);
  return {{x[0], x[1], x[2]}, {v[0], v[1], v[2]}, x[3]};
}

/// to[index[k]] = lane k, one after the other.
template <class Index>
PLEAT_KERNEL void scatter(const Vec3Lanes& lanes, const Lanes& w, const Index* index, Vec4* to) {
  Four each[kLanes];
  split(lanes, w, each);
  for (std::size_t k = 0; k < kLanes; ++k) store(each[k], at(to, index[k]));
}
/// to[index[k]] += lane k, one after the other, for the first `count` lanes.
PLEAT_KERNEL void scatter_add(const Vec3Lanes& lanes, const std::uint32_t* index, std::uint32_t count, Vec4* to) {
  Four each[kLanes];
  split(lanes, Lanes{}, each);
  const auto add = [&](std::uint32_t k) { store(load_four(to[index[k]]) + each[k], to[index[k]]); };
  if (count >= kLanes) {
    for (std::uint32_t k = 0; k < kLanes; ++k) add(k);
  } else {
    for (std::uint32_t k = 0; k < count; ++k) add(k);
  }
}

}  // namespace pleat
