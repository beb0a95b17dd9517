// The program `systems`: what one run of each system of the schedule takes, by cloth and vector set.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "bench/systems/ceilings.h"
#include "bench/systems/moment.h"
#include "components/wide.h"

namespace pleat::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What measuring nothing takes.
double clock_seconds() {
  static const double seconds = [] {
    double least = 1.0;
    for (int i = 0; i < 10000; ++i) least = std::min(least, seconds_since(Clock::now()));
    return least;
  }();
  return seconds;
}

void time_system(benchmark::State& state, const Row& row, SkirtSize size, VectorSet set) {
  vector_limit = set;
  Moment moment(size, row);
  std::array<double, 9> runs;  // their median counts, so that being interrupted does not
  for (auto _ : state) {
    for (double& seconds : runs) {
      moment.rewind();
      const Clock::time_point start = Clock::now();
      moment.run();
      seconds = seconds_since(start);
    }
    std::nth_element(runs.begin(), runs.begin() + 4, runs.end());
    state.SetIterationTime(std::max(runs[4] - clock_seconds(), 0.0));
  }
}

void register_systems() {
  for (const Row& row : schedule_table()) {
    if (!is_needed(row)) continue;
    for (const SkirtSize size : kSkirtSizes) {
      for (const VectorSet set : kVectorSets) {
        if (set > widest_vectors()) continue;
        constexpr const char* kNames[] = {"/baseline", "/avx2", "/avx512"};
        std::string name = row.name;
        name += '/' + std::to_string(size.particles());
        name += kNames[static_cast<std::size_t>(set)];
        benchmark::RegisterBenchmark(name.c_str(), time_system, row, size, set)->UseManualTime();
      }
    }
  }
}

}  // namespace
}  // namespace pleat::bench

int main(int argc, char** argv) {
  char brief[] = "--benchmark_min_time=0.02";  // unless the caller says more: there are hundreds of cases
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, brief);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  pleat::bench::register_ceilings();
  pleat::bench::register_systems();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
