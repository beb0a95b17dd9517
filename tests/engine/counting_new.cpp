#include "tests/engine/counting_new.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> count{0};

void* allocate(std::size_t bytes, std::size_t alignment) {
  ++count;
  // aligned_alloc wants a multiple of the alignment.
  void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define PLEAT_HEAP_IS_TAKEN
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define PLEAT_HEAP_IS_TAKEN
#endif

#ifndef PLEAT_HEAP_IS_TAKEN
std::atomic<std::uint64_t> calls{0};
#endif

}  // namespace

#ifndef PLEAT_HEAP_IS_TAKEN
// In front of glibc's own, whose other names these are.
extern "C" {
void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t count, std::size_t bytes);
void* __libc_realloc(void* memory, std::size_t bytes);

void* malloc(std::size_t bytes) { return ++calls, __libc_malloc(bytes); }
void* calloc(std::size_t number, std::size_t bytes) { return ++calls, __libc_calloc(number, bytes); }
void* realloc(void* memory, std::size_t bytes) { return ++calls, __libc_realloc(memory, bytes); }
}
#endif

namespace pleat {
std::uint64_t global_allocations() { return count; }
std::optional<std::uint64_t> heap_calls() {
#ifdef PLEAT_HEAP_IS_TAKEN
  return std::nullopt;
#else
  return calls;
#endif
}
}  // namespace pleat

void* operator new(std::size_t bytes) { return allocate(bytes, alignof(std::max_align_t)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
