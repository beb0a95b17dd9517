#include "bench/systems/ceilings.h"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "components/wide.h"

namespace pleat::bench {
namespace {

constexpr size_t kChains = 12;  // that do not wait for each other: more than two ports need
constexpr int kRounds = 1000;

template <size_t lanes>
struct Vector {
  typedef float Type __attribute__((vector_size(lanes * sizeof(float))));
};

/// `lanes` is what a register of the set holds.
template <size_t lanes>
void multiply_and_add(benchmark::State& state, VectorSet set) {
  float scale = 0.999f, shift = 1e-3f;
  for (auto _ : state) {
    benchmark::DoNotOptimize(scale);
    run_wide(set, [&] {
      using Register = typename Vector<lanes>::Type;
      Register chain[kChains] = {};
      for (int round = 0; round < kRounds; ++round) {
        for (Register& x : chain) x = x * scale + shift;
      }
      for (const Register& x : chain) shift += 0.0f * x[0];
    });
    benchmark::DoNotOptimize(shift);
  }
  constexpr auto kFlop = static_cast<int64_t>(2 * kRounds * kChains * lanes);
  state.SetItemsProcessed(kFlop * static_cast<int64_t>(state.iterations()));
}

void triad(benchmark::State& state, size_t bytes) {
  const size_t count = bytes / (3 * sizeof(float));
  std::vector<float> a(count), b(count, 1.0f), c(count, 2.0f);
  for (auto _ : state) {
    run_wide(widest_vectors(), [&, to = a.data(), x = b.data(), y = c.data()] {
      for (size_t i = 0; i < count; ++i) to[i] = x[i] + 0.5f * y[i];
    });
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<int64_t>(bytes) * static_cast<int64_t>(state.iterations()));
}

}  // namespace

void register_ceilings() {
  benchmark::RegisterBenchmark("ceiling/flop/baseline", multiply_and_add<4>, VectorSet::kBaseline);
  if (widest_vectors() >= VectorSet::kAvx2) {
    benchmark::RegisterBenchmark("ceiling/flop/avx2", multiply_and_add<8>, VectorSet::kAvx2);
  }
  for (const auto& [name, bytes] :
       {std::pair{"24_KiB", 24 << 10}, std::pair{"1_MiB", 1 << 20}, std::pair{"64_MiB", 64 << 20}}) {
    benchmark::RegisterBenchmark((std::string("ceiling/triad/") + name).c_str(), triad, size_t(bytes));
  }
}

}  // namespace pleat::bench
