// The host's allocator as a standard memory resource, with a tally.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "engine/pleat.h"

namespace pleat {

/// Calls the host's functions, or operator new when they are null. Throws std::bad_alloc when the host returns null.
class HostMemory final : public std::pmr::memory_resource {
 public:
  HostMemory(pleat_allocate_fn host_allocate, pleat_free_fn host_free, void* user)
      : allocate_(host_allocate), release_(host_free), user_(user) {}

  std::uint64_t allocations() const { return allocations_; }
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t peak_bytes() const { return peak_bytes_; }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  pleat_allocate_fn allocate_;
  pleat_free_fn release_;
  void* user_;
  std::uint64_t allocations_ = 0, bytes_ = 0, peak_bytes_ = 0;
};

}  // namespace pleat
