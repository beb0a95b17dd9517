#include "engine/jobs.h"

namespace pleat {

ThreadPool::ThreadPool(std::uint32_t workers) : shares_(workers) {
  threads_.reserve(workers - 1);
  for (std::uint32_t worker = 1; worker < workers; ++worker) {
    threads_.emplace_back([this, worker](const std::stop_token& stop) { wait_for_tasks(stop, worker); });
  }
}

void ThreadPool::run(pleat_task_fn task, std::uint32_t count, void* context) {
  {
    const std::lock_guard lock(mutex_);
    task_ = task, context_ = context;
    const auto first_of = [&](std::size_t worker) {
      return static_cast<std::uint32_t>(worker * count / shares_.size());
    };
    for (std::size_t worker = 0; worker < shares_.size(); ++worker) {
      shares_[worker].next.store(first_of(worker), std::memory_order_relaxed);
      shares_[worker].end = first_of(worker + 1);
    }
    busy_ = static_cast<std::uint32_t>(threads_.size());
    ++round_;
  }
  wake_.notify_all();
  take_tasks(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void ThreadPool::wait_for_tasks(const std::stop_token& stop, std::uint32_t worker) {
  std::uint64_t seen = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [&] { return round_ != seen; })) return;
      seen = round_;
    }
    take_tasks(worker);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void ThreadPool::take_tasks(std::uint32_t worker) {
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    Share& share = shares_[(worker + k) % shares_.size()];
    while (true) {
      const std::uint32_t i = share.next.fetch_add(1, std::memory_order_relaxed);
      if (i >= share.end) break;
      task_(i, worker, context_);
    }
  }
}

}  // namespace pleat
