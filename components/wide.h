// Runs a kernel with the best vector instructions that the processor has. Kernels are plain loops over columns and
// lanes; the compiler makes one version of each for the baseline of the build, one for AVX2 and one for AVX-512 from
// the same source. The last has no wider vectors, which would slow the core's clock, but twice the registers and masks
// of their own. No version may contract or reorder arithmetic (see pleat_options), so all of them give the same bits.
#pragma once

#include <algorithm>

// Clang's flatten takes in what a kernel calls but not what that calls in turn: where little is inlined such a function
// would return its lanes as the baseline does, and AVX code misread them. There kernels stay at the baseline.
#if defined(__clang__)
#define PLEAT_SANITIZED                                                                                      \
  (__has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer) || \
   __has_feature(undefined_behavior_sanitizer))
#if !defined(__OPTIMIZE__) || PLEAT_SANITIZED
#define PLEAT_BASELINE_ONLY
#endif
#endif

#if defined(__x86_64__) && defined(__GNUC__) && !defined(PLEAT_BASELINE_ONLY)
#define PLEAT_TARGET_AVX2 __attribute__((target("avx2"), flatten))
#ifdef __clang__
#define PLEAT_TARGET_AVX512 __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,bmi2"), flatten))
#else
#define PLEAT_TARGET_AVX512 \
  __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,bmi2,prefer-vector-width=256"), flatten))
#endif
#else
#define PLEAT_TARGET_AVX2
#define PLEAT_TARGET_AVX512
#endif
/// For a kernel and its helpers: they are compiled where they are called from, for that target.
#define PLEAT_KERNEL __attribute__((always_inline)) inline

namespace pleat {

enum class VectorSet { kBaseline, kAvx2, kAvx512 };  // a processor that has one has those before it
inline constexpr VectorSet kVectorSets[] = {VectorSet::kBaseline, VectorSet::kAvx2, VectorSet::kAvx512};

inline VectorSet vectors_of_processor() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(PLEAT_BASELINE_ONLY)
  const auto has_all = [](auto... found) { return ((found != 0) && ...); };
  if (has_all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512vl"), __builtin_cpu_supports("avx512dq"),
              __builtin_cpu_supports("avx512bw"), __builtin_cpu_supports("bmi2"))) {
    return VectorSet::kAvx512;
  }
  if (__builtin_cpu_supports("avx2") != 0) return VectorSet::kAvx2;
#endif
  return VectorSet::kBaseline;
}

/// What widest_vectors() says at most. For tests and measurements, and to be set only while no kernel runs.
inline VectorSet vector_limit = VectorSet::kAvx512;

inline VectorSet widest_vectors() {
  static const VectorSet widest = vectors_of_processor();
  return std::min(widest, vector_limit);
}

namespace compiled {
template <class Kernel>
PLEAT_TARGET_AVX512 void run_avx512(const Kernel& kernel) {
  kernel();
}
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
  switch (set) {
    case VectorSet::kAvx512:
      return compiled::run_avx512(kernel);
    case VectorSet::kAvx2:
      return compiled::run_avx2(kernel);
    case VectorSet::kBaseline:
      return compiled::run_baseline(kernel);
  }
}

}  // namespace pleat
