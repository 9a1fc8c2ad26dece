#include "contact/force/projection_kernels.hpp"

#include "contact/numerics/vector_lanes.hpp"

namespace microslip::contact {
namespace {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector type loses its alignment as a template argument,
// so sums are plain arrays.

// The last vector of a harmonic runs over into the next one, which is written after it.
template <int W>
MICROSLIP_INLINE void spread(const ProjectionSizes& size, const double* phi, const double* a,
                             double* y) {
  const std::size_t S = size.n_signals;
  for (std::size_t k = 0; k < size.n_rows; ++k) {
    for (std::size_t s = 0; s < S; ++s) {
      double* row = y + k * size.block + s * size.stride;
      for (std::size_t l = 0; l < size.n_rows; ++l, a += S, row += size.n_modes) {
        for (std::size_t m = 0; m < size.n_modes; m += W) {
          typename Lanes<W>::Vector sum = a[0] * lanes_at<W>(phi + m);
          for (std::size_t t = 1; t < S; ++t)
            sum += a[t] * lanes_at<W>(phi + t * size.phi_stride + m);
          put_lanes<W>(row + m, sum);
        }
      }
    }
  }
}

// I modes by 2 W columns: the sums stay in registers.
template <int W, std::size_t I>
MICROSLIP_INLINE void add_tile(const ProjectionSizes& size, std::size_t n, const double* phi,
                               const double* y, double* sum) {
  using Vector = typename Lanes<W>::Vector;
  Vector left[I] = {};
  Vector right[I] = {};
  for (std::size_t p = 0; p < n; ++p, phi += size.phi_stride, y += size.stride) {
    const Vector first = lanes_at<W>(y);
    const Vector second = lanes_at<W>(y + W);
#pragma GCC unroll 4
    for (std::size_t i = 0; i < I; ++i) {
      left[i] += phi[i] * first;
      right[i] += phi[i] * second;
    }
  }
#pragma GCC unroll 4
  for (std::size_t i = 0; i < I; ++i) {
    double* to = sum + i * size.stride;
    put_lanes<W>(to, lanes_at<W>(to) + left[i]);
    put_lanes<W>(to + W, lanes_at<W>(to + W) + right[i]);
  }
}

template <int W>
MICROSLIP_INLINE void add(const ProjectionSizes& size, std::size_t n, const double* phi,
                          const double* y, double* sum) {
  const std::size_t n_columns = size.n_rows * size.n_modes;
  for (std::size_t j = 0; j < n_columns; j += 2 * W) {
    std::size_t i = 0;
    for (; i + 4 <= size.n_modes; i += 4) {
      add_tile<W, 4>(size, n, phi + i, y + j, sum + i * size.stride + j);
    }
    double* rest = sum + i * size.stride + j;
    switch (size.n_modes - i) {
      case 3:
        add_tile<W, 3>(size, n, phi + i, y + j, rest);
        break;
      case 2:
        add_tile<W, 2>(size, n, phi + i, y + j, rest);
        break;
      case 1:
        add_tile<W, 1>(size, n, phi + i, y + j, rest);
        break;
      default:
        break;
    }
  }
}

// NOLINTEND(modernize-avoid-c-arrays)

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
// One set of kernels per instruction set; the bodies above take on the target of the function they
// are inlined into.
#define MICROSLIP_KERNELS(name, width, attribute)                                                  \
  struct name {                                                                                    \
    attribute static void spread_point(const ProjectionSizes& size, const double* phi,             \
                                       const double* a, double* y) {                               \
      spread<width>(size, phi, a, y);                                                              \
    }                                                                                              \
    attribute static void add_block(const ProjectionSizes& size, std::size_t n, const double* phi, \
                                    const double* y, double* sum) {                                \
      add<width>(size, n, phi, y, sum);                                                            \
    }                                                                                              \
    static constexpr ProjectionKernels all{spread_point, add_block};                               \
  };

// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, 2, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, 4, [[gnu::target("avx2,fma")]])
MICROSLIP_KERNELS(Avx512Kernels, 8, [[gnu::target("avx512f,fma")]])
constexpr const ProjectionKernels* avx2 = &Avx2Kernels::all;
constexpr const ProjectionKernels* avx512 = &Avx512Kernels::all;
#else
constexpr const ProjectionKernels* avx2 = nullptr;
constexpr const ProjectionKernels* avx512 = nullptr;
#endif

}  // namespace

std::vector<const ProjectionKernels*> runnable_projection_kernels() {
  return runnable_kernels(PlainKernels::all, avx2, avx512);
}

const ProjectionKernels& projection_kernels() {
  static const ProjectionKernels& fastest = *runnable_projection_kernels().back();
  return fastest;
}

}  // namespace microslip::contact
