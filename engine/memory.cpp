#include "engine/memory.h"

#include <algorithm>
#include <new>

namespace pleat {

void* HostMemory::do_allocate(std::size_t bytes, std::size_t alignment) {
  void* memory =
      allocate_ != nullptr ? allocate_(bytes, alignment, user_) : ::operator new (bytes, std::align_val_t{alignment});
  if (memory == nullptr) throw std::bad_alloc();
  ++allocations_;
  bytes_ += bytes;
  peak_bytes_ = std::max(peak_bytes_, bytes_);
  return memory;
}

void HostMemory::do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) {
  bytes_ -= bytes;
  if (release_ != nullptr) {
    release_(memory, bytes, alignment, user_);
  } else {
    ::operator delete (memory, std::align_val_t{alignment});
  }
}

}  // namespace pleat
