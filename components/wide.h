// Runs a kernel with the widest vectors that the processor has. Kernels are plain loops over columns and lanes; the
// compiler makes one version of each for the baseline of the build and one for AVX2 from the same source. No version
// may contract or reorder arithmetic (see pleat_options), so all of them give the same bits.
#pragma once

#include <algorithm>

#if defined(__x86_64__) && defined(__GNUC__)
#define PLEAT_TARGET_AVX2 __attribute__((target("avx2"), flatten))
#define PLEAT_HAS_AVX2 (__builtin_cpu_supports("avx2") != 0)
#else
#define PLEAT_TARGET_AVX2
#define PLEAT_HAS_AVX2 false
#endif
/// For a kernel and its helpers: they are compiled where they are called from, for that target.
#define PLEAT_KERNEL __attribute__((always_inline)) inline

namespace pleat {

enum class VectorSet { kBaseline, kAvx2 };

/// What widest_vectors() says at most. For tests and measurements, and to be set only while no kernel runs.
inline VectorSet vector_limit = VectorSet::kAvx2;

inline VectorSet widest_vectors() {
  static const VectorSet widest = PLEAT_HAS_AVX2 ? VectorSet::kAvx2 : VectorSet::kBaseline;
  return std::min(widest, vector_limit);
}

namespace compiled {
template <class Kernel>
PLEAT_TARGET_AVX2 void run_avx2(const Kernel& kernel) {
  kernel();
}
template <class Kernel>
void run_baseline(const Kernel& kernel) {
  kernel();
}
}  // namespace compiled

/// Calls kernel(), compiled for `set`, which the processor must have. What it calls has to be defined in the same file
/// or inline: it is compiled in.
template <class Kernel>
void run_wide(VectorSet set, const Kernel& kernel) {
  set == VectorSet::kAvx2 ? compiled::run_avx2(kernel) : compiled::run_baseline(kernel);
}

}  // namespace pleat
