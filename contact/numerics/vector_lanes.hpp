/// @file
/// Vectors of doubles for inner loops that are compiled once per instruction set, and the choice between
/// the sets at run time. The bodies are inlined into functions that carry the target.
#pragma once

#include <vector>

#define MICROSLIP_INLINE [[gnu::always_inline]] inline

namespace microslip::contact {

/// W doubles side by side; aligned as the arrays are, to one double only.
template <int W>
struct Lanes {
  using Vector
      [[gnu::vector_size(W * sizeof(double)), gnu::aligned(sizeof(double)), gnu::may_alias]] =
          double;
};

/// The W numbers from here on.
template <int W>
MICROSLIP_INLINE const typename Lanes<W>::Vector& lanes_at(const double* from) {
  return *reinterpret_cast<const typename Lanes<W>::Vector*>(from);
}

template <int W>
MICROSLIP_INLINE typename Lanes<W>::Vector& lanes_at(double* to) {
  return *reinterpret_cast<typename Lanes<W>::Vector*>(to);
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
