/// @file
/// Vectors of doubles for inner loops that are compiled once per instruction set, and the choice
/// between the sets at run time. The bodies are inlined into functions that carry the target.
#pragma once

#include <vector>

#define MICROSLIP_INLINE [[gnu::always_inline]] inline
// In front of its body. A lambda that is called has no target: it returns a vector another way than
// the kernel takes it.
#define MICROSLIP_INLINE_LAMBDA __attribute__((always_inline))

namespace microslip::contact {

/// W doubles side by side.
template <int W>
struct Lanes {
  using Vector [[gnu::vector_size(W * sizeof(double))]] = double;
};

// Arrays are aligned to one double only: they are copied, which is one instruction, instead of seen
// through a vector type of that alignment, which Clang forgets in templates.

/// The W numbers from here on.
template <int W>
MICROSLIP_INLINE typename Lanes<W>::Vector lanes_at(const double* from) {
  typename Lanes<W>::Vector lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

template <int W>
MICROSLIP_INLINE void put_lanes(double* to, const typename Lanes<W>::Vector& lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

/// Those of one kind of kernels that this machine can run, the fastest last.
template <class Kernels>
std::vector<const Kernels*> runnable_kernels(const Kernels& plain,
                                             [[maybe_unused]] const Kernels* avx2,
                                             [[maybe_unused]] const Kernels* avx512) {
  std::vector<const Kernels*> runnable{&plain};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("fma") == 0) return runnable;
  if (__builtin_cpu_supports("avx2") != 0) runnable.push_back(avx2);
  if (__builtin_cpu_supports("avx512f") != 0) runnable.push_back(avx512);
#endif
  return runnable;
}

}  // namespace microslip::contact
