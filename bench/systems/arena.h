// Memory of a world in one piece, so that all of it can be kept and put back.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>

#include "engine/pleat.h"

namespace pleat::bench {

/// Gives out memory from the front and takes none back.
class Arena {
 public:
  static void* allocate(size_t bytes, size_t alignment, void* arena) {
    Arena& self = *static_cast<Arena*>(arena);
    const size_t begin = (self.used_ + alignment - 1) / alignment * alignment;
    if (begin + bytes > kBytes) return nullptr;
    self.used_ = begin + bytes;
    return self.memory_.get() + begin;
  }
  static void release(void*, size_t, size_t, void*) {}

  std::span<std::byte> used() { return {memory_.get(), used_}; }

 private:
  static constexpr size_t kBytes = size_t{64} << 20, kPage = 4096;
  struct Free {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  std::unique_ptr<std::byte, Free> memory_{static_cast<std::byte*>(std::aligned_alloc(kPage, kBytes))};
  size_t used_ = 0;
};

}  // namespace pleat::bench
