#include "contact/force/block_kernels.hpp"

#include "contact/numerics/vector_lanes.hpp"

namespace microslip::contact {
namespace {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector type loses its attributes as a template
// argument, so sums are plain arrays.

template <int W>
MICROSLIP_INLINE double total(const typename Lanes<W>::Vector& x) {
  double sum = 0.0;
  for (int k = 0; k < W; ++k) {
    sum += x[k];
  }
  return sum;
}

template <int W>
MICROSLIP_INLINE void add_force(std::size_t n_modes, std::size_t n_points, const double* phi,
                                const double* force, double* sum) {
  using Vector = typename Lanes<W>::Vector;
  for (std::size_t mode = 0; mode < n_modes; ++mode) {
    Vector s[3] = {};
    for (std::size_t point = 0; point < n_points; point += W) {
      const Vector shape = lanes_at<W>(phi + mode * block_points + point);
      for (std::size_t r = 0; r < 3; ++r) {
        s[r] += shape * lanes_at<W>(force + r * block_points + point);
      }
    }
    for (std::size_t r = 0; r < 3; ++r) {
      sum[r * n_modes + mode] += total<W>(s[r]);
    }
  }
}

// One pair of modes: E sums share the product of the two shapes and stay in registers.
template <int W, std::size_t E>
MICROSLIP_INLINE void add_pair(std::size_t n_points, const double* phi, const double* psi,
                               const double* a, double* sum) {
  using Vector = typename Lanes<W>::Vector;
  Vector s[E] = {};
  for (std::size_t point = 0; point < n_points; point += W) {
    const Vector product = lanes_at<W>(phi + point) * lanes_at<W>(psi + point);
#pragma GCC unroll 16
    for (std::size_t e = 0; e < E; ++e) {
      s[e] += product * lanes_at<W>(a + e * block_points + point);
    }
  }
#pragma GCC unroll 16
  for (std::size_t e = 0; e < E; ++e) {
    sum[e] += total<W>(s[e]);
  }
}

template <int W, std::size_t E>
MICROSLIP_INLINE void add_products(std::size_t n_modes, std::size_t n_points, const double* phi,
                                   const double* psi, const double* a, double* sum, bool half) {
  for (std::size_t i = 0; i < n_modes; ++i) {
    const std::size_t n_j = half ? i + 1 : n_modes;
    for (std::size_t j = 0; j < n_j; ++j) {
      add_pair<W, E>(n_points, phi + i * block_points, psi + j * block_points, a,
                     sum + (i * n_modes + j) * E);
    }
  }
}

// NOLINTEND(modernize-avoid-c-arrays)

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
// One set of kernels per instruction set; the bodies above take on the target of the function they
// are inlined into.
#define MICROSLIP_KERNELS(name, width, attribute)                                                 \
  struct name {                                                                                   \
    attribute static void force(std::size_t n, std::size_t k, const double* phi, const double* f, \
                                double* g) {                                                      \
      add_force<width>(n, k, phi, f, g);                                                          \
    }                                                                                             \
    attribute static void products_9(std::size_t n, std::size_t k, const double* phi,             \
                                     const double* psi, const double* a, double* c) {             \
      add_products<width, 9>(n, k, phi, psi, a, c, false);                                        \
    }                                                                                             \
    attribute static void products_7(std::size_t n, std::size_t k, const double* phi,             \
                                     const double* a, double* c) {                                \
      add_products<width, 7>(n, k, phi, phi, a, c, true);                                         \
    }                                                                                             \
    attribute static void products_6(std::size_t n, std::size_t k, const double* phi,             \
                                     const double* a, double* c) {                                \
      add_products<width, 6>(n, k, phi, phi, a, c, true);                                         \
    }                                                                                             \
    static constexpr BlockKernels all{force, products_9, products_7, products_6};                 \
  };

// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, 2, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, 4, [[gnu::target("avx2,fma")]])
MICROSLIP_KERNELS(Avx512Kernels, 8, [[gnu::target("avx512f,fma")]])
constexpr const BlockKernels* avx2 = &Avx2Kernels::all;
constexpr const BlockKernels* avx512 = &Avx512Kernels::all;
#else
constexpr const BlockKernels* avx2 = nullptr;
constexpr const BlockKernels* avx512 = nullptr;
#endif

}  // namespace

std::vector<const BlockKernels*> runnable_block_kernels() {
  return runnable_kernels(PlainKernels::all, avx2, avx512);
}

const BlockKernels& block_kernels() {
  static const BlockKernels& fastest = *runnable_block_kernels().back();
  return fastest;
}

}  // namespace microslip::contact
