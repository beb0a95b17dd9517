#include "engine/jobs.h"

#include <gtest/gtest.h>

#include <vector>

namespace pleat {
namespace {

struct Tally {
  std::vector<std::atomic<int>> calls, running;
  std::atomic<bool> shared = false;

  Tally(std::size_t tasks, std::size_t workers) : calls(tasks), running(workers) {}
  static void task(std::uint32_t index, std::uint32_t worker, void* context) {
    Tally& tally = *static_cast<Tally*>(context);
    if (tally.running[worker].fetch_add(1) != 0) tally.shared = true;
    ++tally.calls[index];
    --tally.running[worker];
  }
};

TEST(ThreadPool, EachTaskRunsOnceAndNoWorkerIsTwoAtATime) {
  for (const std::uint32_t workers : {1u, 2u, 3u, 8u}) {
    ThreadPool pool(workers);
    for (const std::uint32_t tasks : {0u, 1u, 2u, 7u, 1000u}) {
      Tally tally(tasks, workers);
      pool.run(Tally::task, tasks, &tally);
      for (std::uint32_t i = 0; i < tasks; ++i) EXPECT_EQ(tally.calls[i], 1) << workers << " workers, task " << i;
      EXPECT_FALSE(tally.shared);
    }
  }
}

TEST(ThreadPool, RoundAfterRound) {
  ThreadPool pool(3);
  Tally tally(5, 3);
  for (int round = 0; round < 2000; ++round) pool.run(Tally::task, 5, &tally);
  for (const std::atomic<int>& calls : tally.calls) EXPECT_EQ(calls, 2000);
}

}  // namespace
}  // namespace pleat
