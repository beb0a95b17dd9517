// What goes over a state, number by number: to count its bytes, to write them, to check and to read them.
#pragma once

#include <type_traits>
#include <utility>

#include "components/rigid_pose.h"
#include "engine/border.h"

namespace pleat {

/// What a number of a state may be; anything else would not have been written.
struct Range {
  double low, high;
};
inline constexpr double kMost = 1e18;  // so that squares of vectors are floats too
inline constexpr Range kFinite{-kMost, kMost}, kPositive{0.0, kMost}, kShare{0.0, 1.0}, kUnit{-1.01, 1.01},
    kYesOrNo{0.0, 1.0};
inline constexpr Range kPlace{-16.0 * double{kFarthest}, 16.0 * double{kFarthest}};  // m, after a jump too
inline constexpr Range kNormal{-1.00001, 1.00001};  // of a unit vector, as 16 bits hold it too
inline constexpr Range kTime{0.0, 1e12};            // s
inline constexpr Range kCount{0.0, 9e18};

/// How many bytes there are.
struct Counting {
  std::uint64_t bytes = 0;

  template <class T>
  void same(const char*, T, std::uint32_t = 0) {
    bytes += sizeof(T);
  }
  template <class T>
  void array(const char*, const T*, std::size_t count, Range) {
    bytes += count * sizeof(T);
  }
  void need(bool, const char*) {}
};

struct Writing {
  char* to;

  template <class T>
  void same(const char* name, T value, std::uint32_t = 0) {
    array(name, &value, 1, kCount);
  }
  template <class T>
  void array(const char*, const T* data, std::size_t count, Range) {
    if (count == 0) return;
    std::memcpy(to, data, count * sizeof(T));
    to += count * sizeof(T);
  }
  void need(bool, const char*) {}
};

/// What is const is not changed: so a world is compared with the bytes first, which checks all of them.
struct Reading {
  const char* from;
  std::uint64_t left;

  /// Must be as in this world. of: which cloth or body.
  template <class T>
  void same(const char* name, T value, std::uint32_t of = kNone) {
    T there;
    std::memcpy(&there, take(sizeof(T)), sizeof(T));
    if (there == value) return;
    std::string line = std::string("the state's ") + name;
    if (of != kNone) line += ' ', line += std::to_string(of);
    refuse(line + " is " + std::to_string(there) + ", here it is " + std::to_string(value));
  }
  template <class T>
  void array(const char* name, const T*, std::size_t count, Range range) {
    check<T>(name, take(count * sizeof(T)), count, range);
  }
  template <class T>
  void array(const char* name, T* data, std::size_t count, Range range) {
    const char* begin = take(count * sizeof(T));
    check<T>(name, begin, count, range);
    if (count != 0) std::memcpy(data, begin, count * sizeof(T));
  }
  /// What numbers must be to each other.
  void need(bool holds, const char* otherwise) {
    if (!holds) refuse(otherwise);
  }

 private:
  const char* take(std::uint64_t bytes) {
    if (bytes > left) refuse("bytes is too small: the state is cut off");
    left -= bytes;
    return std::exchange(from, from + bytes);
  }
  template <class T>
  static void check(const char* name, const char* begin, std::size_t count, Range range) {
    const T low = static_cast<T>(range.low), high = static_cast<T>(range.high);
    bool good = true;
    for (std::size_t i = 0; i < count; ++i) {
      T value;
      std::memcpy(&value, begin + i * sizeof(T), sizeof(T));
      good &= value >= low && value <= high;  // false for NaN
    }
    if (!good) {
      refuse(std::string("the state's ") + name + " is not from " + text(range.low) + " to " + text(range.high));
    }
  }
};

/// One number of the world, which is only read where it is const. Returns what it is, in the bytes where they are read.
template <class Io, class T>
auto number(Io& io, const char* name, T& x, Range range) {
  std::remove_const_t<T> value = x;
  io.array(name, &value, 1, range);
  if constexpr (!std::is_const_v<T>) x = value;
  return value;
}
template <class Io, class Bool>
bool flag(Io& io, const char* name, Bool& x) {
  std::uint32_t value = x ? 1 : 0;
  io.array(name, &value, 1, kYesOrNo);
  if constexpr (!std::is_const_v<Bool>) x = value != 0;
  return value != 0;
}
template <class Io, class V>
void vector(Io& io, const char* name, V& v, Range range) {
  number(io, name, v.x, range), number(io, name, v.y, range), number(io, name, v.z, range);
}
template <class Io, class View>
void vectors(Io& io, const char* name, const View& v, std::size_t count, Range range) {
  io.array(name, v.x, count, range), io.array(name, v.y, count, range), io.array(name, v.z, count, range);
}
template <class Io, class Q>
void rotation(Io& io, const char* name, Q& q) {
  Quaternion r = q;
  number(io, name, r.x, kUnit), number(io, name, r.y, kUnit), number(io, name, r.z, kUnit),
      number(io, name, r.w, kUnit);
  if (!(std::abs(dot(r, r) - 1.0f) <= 0.02f)) refuse(std::string("the state's ") + name + " is no unit quaternion");
  if constexpr (!std::is_const_v<Q>) q = r;
}
template <class Io, class Pose>
void pose(Io& io, const char* name, Pose& p) {
  vector(io, name, p.position, kPlace);
  rotation(io, name, p.rotation);
}

}  // namespace pleat
