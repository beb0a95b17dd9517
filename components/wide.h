// Runs a kernel with the best vector instructions that the processor has. Kernels are plain loops over columns and
// lanes; the compiler makes one version of each for the baseline of the build, one for AVX2 and one for AVX-512 from
// the same source. The last has no wider vectors, which would slow the core's clock, but twice the registers and masks
// of their own. No version may contract or reorder arithmetic (see pleat_options), so all of them give the same bits.
#pragma once

#include <algorithm>

#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
#define PLEAT_CHECKED  // built to find mistakes, not to be fast
#elif defined(__clang__)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(undefined_behavior_sanitizer)
#define PLEAT_CHECKED
#endif
#endif

#if defined(__x86_64__) && defined(__GNUC__)
#define PLEAT_TARGET_AVX2 __attribute__((target("avx2"), flatten, noinline))
#ifdef __clang__
#define PLEAT_TARGET_AVX512 __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,bmi2"), flatten, noinline))
#else
#define PLEAT_TARGET_AVX512 \
  __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,bmi2,prefer-vector-width=256"), flatten, noinline))
#endif
#else
#define PLEAT_TARGET_AVX2
#define PLEAT_TARGET_AVX512
#endif
/// For a kernel and its helpers: they are compiled where they are called from, for that target.
#define PLEAT_KERNEL __attribute__((always_inline)) inline
/// The same for a lambda that a kernel hands to a helper, behind its parameters: clang would leave it out of line, and
/// what is out of line is compiled for the baseline.
#define PLEAT_KERNEL_LAMBDA __attribute__((always_inline))

namespace pleat {

enum class VectorSet { kBaseline, kAvx2, kAvx512 };  // a processor that has one has those before it
inline constexpr VectorSet kVectorSets[] = {VectorSet::kBaseline, VectorSet::kAvx2, VectorSet::kAvx512};

/// What kernels are compiled for at most. Builds to find mistakes do with the baseline, in which the same source runs
/// by the same choices: there, other versions take longer to compile than all else together. Nor would clang's work:
/// its flatten takes in what a kernel calls but not what that calls in turn, which, where little is inlined, would
/// return its lanes as the baseline does, and AVX code misread them.
#if !defined(__x86_64__) || !defined(__GNUC__) || defined(PLEAT_CHECKED)
inline constexpr VectorSet kMostVectors = VectorSet::kBaseline;
#else
inline constexpr VectorSet kMostVectors = VectorSet::kAvx512;
#endif

inline VectorSet vectors_of_processor() {
  VectorSet found = VectorSet::kBaseline;
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2") != 0) found = VectorSet::kAvx2;
  const auto has_all = [](auto... has) { return ((has != 0) && ...); };
  if (has_all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512vl"), __builtin_cpu_supports("avx512dq"),
              __builtin_cpu_supports("avx512bw"), __builtin_cpu_supports("bmi2"))) {
    found = VectorSet::kAvx512;
  }
#endif
  return found;
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
__attribute__((noinline)) void run_baseline(const Kernel& kernel) {
  kernel();
}
}  // namespace compiled

/// Calls kernel(), compiled for `set`, which the processor must have, or for kMostVectors. What it calls has to be
/// defined in the same file or inline: it is compiled in. A kernel may hand a large part of itself, that is
/// reached from several places, to run_wide again: then there is one copy of that part.
template <class Kernel>
void run_wide(VectorSet set, const Kernel& kernel) {
  if constexpr (kMostVectors >= VectorSet::kAvx512) {
    if (set == VectorSet::kAvx512) return compiled::run_avx512(kernel);
  }
  if constexpr (kMostVectors >= VectorSet::kAvx2) {
    if (set == VectorSet::kAvx2) return compiled::run_avx2(kernel);
  }
  compiled::run_baseline(kernel);
}

}  // namespace pleat
