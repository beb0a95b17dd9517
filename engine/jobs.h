// Runs tasks on some threads at a time: the host's, or a few of our own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/pleat.h"

namespace pleat {

/// Threads that wait for tasks. The one that asks works as worker 0, each thread as one of the others. Each begins with
/// a share of the tasks of its own, round after round the same, whose data are then in its core's caches, and goes on
/// with what others have left of theirs. Asking allocates nothing; apart from waking the threads and waiting for the
/// last there is no lock.
class ThreadPool {
 public:
  /// `workers` - 1 threads. Throws std::bad_alloc, std::system_error.
  explicit ThreadPool(std::uint32_t workers);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// task(index, worker, context) once for each index < count; returns when all are done. Not from two threads at once.
  void run(pleat_task_fn task, std::uint32_t count, void* context);

 private:
  struct alignas(64) Share {  // a line of the cache each
    std::atomic<std::uint32_t> next = 0;
    std::uint32_t end = 0;
  };

  void wait_for_tasks(const std::stop_token& stop, std::uint32_t worker);
  void take_tasks(std::uint32_t worker);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::condition_variable done_;
  std::uint64_t round_ = 0;  // of tasks
  std::uint32_t busy_ = 0;   // threads that have not finished this round
  pleat_task_fn task_ = nullptr;
  void* context_ = nullptr;
  std::vector<Share> shares_;          // one a worker
  std::vector<std::jthread> threads_;  // last: they stop before what they use goes
};

}  // namespace pleat
