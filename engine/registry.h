// Handles {index, generation} to the elements of a dense array that closes its gaps.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

namespace pleat {

/// Makes room for one more element, so that the next push_back cannot fail. Throws std::bad_alloc; unchanged then.
template <class Vector>
void reserve_one_more(Vector& vector) {
  if (vector.size() == vector.capacity()) vector.reserve(2 * vector.size() + 8);
}

struct Handle {
  std::uint32_t index = 0, generation = 0;
};

/// Maps handles to dense positions. Generations start at 1, so an all-zero handle is never valid; a slot whose
/// generation would wrap is retired.
class Registry {
 public:
  explicit Registry(std::pmr::memory_resource* memory) : slots_(memory), dense_(memory), free_(memory) {}

  std::uint32_t size() const { return static_cast<std::uint32_t>(dense_.size()); }

  /// Makes room, so that the next add cannot fail. Throws std::bad_alloc.
  void reserve_one() {
    reserve_one_more(slots_);
    reserve_one_more(dense_);
    if (free_.capacity() < slots_.capacity()) free_.reserve(slots_.capacity());  // remove must not fail either
  }

  /// A handle for a new last element.
  Handle add() {
    std::uint32_t slot = static_cast<std::uint32_t>(slots_.size());
    if (free_.empty()) {
      slots_.push_back({});
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    slots_[slot].position = size();
    dense_.push_back(slot);
    return {slot, slots_[slot].generation};
  }

  std::optional<std::uint32_t> find(Handle handle) const {
    if (handle.index >= slots_.size()) return std::nullopt;
    const Slot& slot = slots_[handle.index];
    if (slot.generation != handle.generation || slot.position == kFree) return std::nullopt;
    return slot.position;
  }

  /// position < size().
  Handle handle(std::uint32_t position) const { return {dense_[position], slots_[dense_[position]].generation}; }

  /// Forgets the element at `position`; all behind it move down by one.
  void remove(std::uint32_t position) {
    const std::uint32_t slot = dense_[position];
    dense_.erase(dense_.begin() + position);
    for (std::uint32_t i = position; i < size(); ++i) slots_[dense_[i]].position = i;
    slots_[slot].position = kFree;
    if (++slots_[slot].generation != 0) free_.push_back(slot);
  }

 private:
  static constexpr std::uint32_t kFree = 0xffffffffu;
  struct Slot {
    std::uint32_t position = kFree, generation = 1;
  };
  std::pmr::vector<Slot> slots_;
  std::pmr::vector<std::uint32_t> dense_, free_;
};

}  // namespace pleat
