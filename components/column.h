// The one container of the components: a flat array of one quantity, 64-byte aligned, padded to whole groups of 16 so
// that a kernel needs no tail, on the host's memory.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory_resource>
#include <type_traits>
#include <utility>

#include "components/vec3.h"

namespace pleat {

inline constexpr std::size_t kColumnAlignment = 64;  // bytes: a cache line, an AVX-512 register
inline constexpr std::size_t kColumnPadding = 16;    // elements

/// n rounded up to whole padding groups.
constexpr std::size_t padded(std::size_t n) { return (n + kColumnPadding - 1) / kColumnPadding * kColumnPadding; }

/// A resizable column of trivially copyable T. Elements from size() up to the capacity hold the fill value.
/// Throws std::bad_alloc when the memory resource does; the column is unchanged then.
template <class T>
class Column {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit Column(std::pmr::memory_resource* memory, T fill = T{}) : memory_(memory), fill_(fill) {}
  Column(Column&& other) noexcept
      : memory_(other.memory_),
        fill_(other.fill_),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  Column& operator=(Column&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(fill_, other.fill_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~Column() { release(); }

  /// Makes room, so that resizing up to `size` cannot fail.
  void reserve(std::size_t size) {
    const std::size_t wanted = padded(size);
    if (wanted <= capacity_) return;
    const std::size_t capacity = std::max(wanted, padded(capacity_ + capacity_ / 2));
    T* grown = static_cast<T*>(memory_->allocate(capacity * sizeof(T), kColumnAlignment));
    std::copy(data_, data_ + size_, grown);
    std::fill(grown + size_, grown + capacity, fill_);
    release();
    data_ = grown;
    capacity_ = capacity;
  }
  /// Keeps the elements below min(old, new) size; new ones get the fill value. Capacity never shrinks.
  void resize(std::size_t size) {
    reserve(size);
    if (size < size_) std::fill(data_ + size, data_ + size_, fill_);
    size_ = size;
  }
  void push_back(T value) {
    resize(size_ + 1);
    data_[size_ - 1] = value;
  }
  /// Removes [begin, begin + count) and closes the gap.
  void erase(std::size_t begin, std::size_t count) {
    assert(begin + count <= size_);
    std::copy(data_ + begin + count, data_ + size_, data_ + begin);
    resize(size_ - count);
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return capacity_ * sizeof(T); }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return assert(i < size_), data_[i]; }
  const T& operator[](std::size_t i) const { return assert(i < size_), data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  void release() {
    if (data_ != nullptr) memory_->deallocate(data_, capacity_ * sizeof(T), kColumnAlignment);
    data_ = nullptr;
  }

  std::pmr::memory_resource* memory_;
  T fill_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// Read-only view of vectors kept as three columns.
struct ConstVec3View {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;

  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  ConstVec3View from(std::size_t begin) const { return {x + begin, y + begin, z + begin}; }
};

/// Writable view of vectors kept as three columns.
struct Vec3View {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;

  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3& v) const { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  void add(std::size_t i, const Vec3& v) const { x[i] += v.x, y[i] += v.y, z[i] += v.z; }
  Vec3View from(std::size_t begin) const { return {x + begin, y + begin, z + begin}; }
  operator ConstVec3View() const { return {x, y, z}; }
};

/// Room for `size` elements or vectors, where there is less.
template <class AnyColumn>
void at_least(AnyColumn& column, std::size_t size) {
  if (column.size() < size) column.resize(size);
}

/// The first `count` vectors.
inline void clear(const Vec3View& v, std::size_t count) {
  std::fill_n(v.x, count, 0.0f), std::fill_n(v.y, count, 0.0f), std::fill_n(v.z, count, 0.0f);
}
inline void copy(const Vec3View& to, const ConstVec3View& from, std::size_t count) {
  std::copy_n(from.x, count, to.x), std::copy_n(from.y, count, to.y), std::copy_n(from.z, count, to.z);
}

/// Vectors as three columns.
struct Vec3Column {
  Column<float> x, y, z;

  explicit Vec3Column(std::pmr::memory_resource* memory) : x(memory), y(memory), z(memory) {}
  void reserve(std::size_t size) { x.reserve(size), y.reserve(size), z.reserve(size); }
  void resize(std::size_t size) {
    reserve(size);
    x.resize(size), y.resize(size), z.resize(size);
  }
  void erase(std::size_t begin, std::size_t count) {
    x.erase(begin, count), y.erase(begin, count), z.erase(begin, count);
  }
  std::size_t size() const { return x.size(); }
  std::size_t bytes() const { return x.bytes() + y.bytes() + z.bytes(); }
  Vec3View view() { return {x.data(), y.data(), z.data()}; }
  ConstVec3View view() const { return {x.data(), y.data(), z.data()}; }
};

}  // namespace pleat
