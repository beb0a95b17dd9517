// A memory resource that says no after a number of allocations, and knows what it has given out.
#pragma once

#include <memory_resource>
#include <new>

namespace pleat {

class FailingMemory final : public std::pmr::memory_resource {
 public:
  explicit FailingMemory(int allowed) : allowed_(allowed) {}

  int live() const { return live_; }
  void allow(int count) { allowed_ = count; }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (allowed_-- <= 0) throw std::bad_alloc();
    ++live_;
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    --live_;
    std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  int allowed_, live_ = 0;
};

}  // namespace pleat
