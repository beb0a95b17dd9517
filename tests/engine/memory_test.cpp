#include "engine/memory.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace pleat {
namespace {

struct Host {
  std::size_t calls = 0, bytes = 0, last_alignment = 0;
  bool refuse = false;

  static void* allocate(std::size_t bytes, std::size_t alignment, void* user) {
    Host& host = *static_cast<Host*>(user);
    if (host.refuse) return nullptr;
    ++host.calls;
    host.bytes += bytes;
    host.last_alignment = alignment;
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  static void release(void* memory, std::size_t bytes, std::size_t, void* user) {
    static_cast<Host*>(user)->bytes -= bytes;
    std::free(memory);
  }
};

TEST(HostMemory, GoesThroughTheHostAndTallies) {
  Host host;
  HostMemory memory(&Host::allocate, &Host::release, &host);
  std::pmr::memory_resource& resource = memory;
  void* a = resource.allocate(100, 64);
  void* b = resource.allocate(50, 16);
  EXPECT_EQ(host.calls, 2u);
  EXPECT_EQ(host.last_alignment, 16u);
  EXPECT_EQ(memory.allocations(), 2u);
  EXPECT_EQ(memory.bytes(), 150u);
  resource.deallocate(a, 100, 64);
  EXPECT_EQ(memory.bytes(), 50u);
  EXPECT_EQ(memory.peak_bytes(), 150u);
  resource.deallocate(b, 50, 16);
  EXPECT_EQ(host.bytes, 0u);
}

TEST(HostMemory, TurnsNullIntoBadAllocWithoutCountingIt) {
  Host host;
  host.refuse = true;
  HostMemory memory(&Host::allocate, &Host::release, &host);
  EXPECT_THROW((void)static_cast<std::pmr::memory_resource&>(memory).allocate(1, 1), std::bad_alloc);
  EXPECT_EQ(memory.allocations(), 0u);
  EXPECT_EQ(memory.bytes(), 0u);
}

TEST(HostMemory, FallsBackOnOperatorNewAligned) {
  HostMemory memory(nullptr, nullptr, nullptr);
  std::pmr::memory_resource& resource = memory;
  void* a = resource.allocate(10, 64);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a) % 64, 0u);
  resource.deallocate(a, 10, 64);
  EXPECT_EQ(memory.bytes(), 0u);
}

}  // namespace
}  // namespace pleat
