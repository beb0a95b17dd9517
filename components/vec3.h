// Three floats and the arithmetic that the kernels need. Eigen is not used here on purpose: these types cross
// translation units built with different instruction sets, and the element type is a template parameter so that a
// kernel can be run with a SIMD lane type in place of float.
#pragma once

#include <cmath>
#include <type_traits>

namespace pleat {

template <class T>
struct Vec3T {
  T x{}, y{}, z{};

  constexpr Vec3T& operator+=(const Vec3T& b) { return *this = *this + b; }
  constexpr Vec3T& operator-=(const Vec3T& b) { return *this = *this - b; }
  constexpr Vec3T& operator*=(T s) { return *this = *this * s; }
  friend constexpr Vec3T operator+(const Vec3T& a, const Vec3T& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3T operator-(const Vec3T& a, const Vec3T& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3T operator-(const Vec3T& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3T operator*(const Vec3T& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3T operator*(T s, const Vec3T& a) { return a * s; }
  /// Lanes by a number that they share.
  friend constexpr Vec3T operator*(const Vec3T& a, float s) requires(!std::is_same_v<T, float>) {
    return {a.x * s, a.y * s, a.z * s};
  }
  friend constexpr bool operator==(const Vec3T&, const Vec3T&) = default;
};

template <class T>
constexpr T dot(const Vec3T<T>& a, const Vec3T<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr Vec3T<T> cross(const Vec3T<T>& a, const Vec3T<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length(const Vec3T<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// Unit vector along a, or `otherwise` where a is too short to have a direction.
template <class T>
Vec3T<T> normalized_or(const Vec3T<T>& a, const Vec3T<T>& otherwise) {
  const T l = length(a);
  return l > T(1e-12) ? a * (T(1) / l) : otherwise;
}

template <class T>
bool is_finite(const Vec3T<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

using Vec3 = Vec3T<float>;

inline Vec3 lerp(const Vec3& a, const Vec3& b, float t) { return a + (b - a) * t; }

}  // namespace pleat
