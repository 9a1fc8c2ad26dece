#include "contact/lanes/product_kernels.hpp"

#include "contact/lanes/pack.hpp"

namespace microslip::contact::sampled {
namespace {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector type loses its alignment as a template argument.

template <class Pack, std::size_t S>
MICROSLIP_INLINE void spread_signals(std::size_t n_modes, std::size_t n_rows,
                                     const std::array<const double*, 3>& J,
                                     const std::array<std::vector<double>, 3>& phi, double* y) {
  const double* shape_0 = phi[0].data();
  const double* shape_1 = phi[1].data();
  const double* shape_2 = phi[2].data();
  for (std::size_t m = 0; m < n_modes; ++m, y += n_rows) {
    for (std::size_t l = 0; l < n_rows; l += pack_size<Pack>) {
      Pack sum = shape_0[m] * pack_at<Pack>(J[0] + l) + shape_1[m] * pack_at<Pack>(J[1] + l);
      if constexpr (S == 3) sum += shape_2[m] * pack_at<Pack>(J[2] + l);
      put_pack(y + l, sum);
    }
  }
}

template <class Pack>
MICROSLIP_INLINE void spread_all(std::size_t n_signals, std::size_t n_modes, std::size_t n_rows,
                                 const std::array<const double*, 3>& J,
                                 const std::array<std::vector<double>, 3>& phi, double* y) {
  if (n_signals == 2) {
    spread_signals<Pack, 2>(n_modes, n_rows, J, phi, y);
  } else {
    spread_signals<Pack, 3>(n_modes, n_rows, J, phi, y);
  }
}

// I rows of C by 3 W columns: the sums stay in registers.
template <int W, std::size_t I>
MICROSLIP_INLINE void product_tile(const ProductSizes& size, std::size_t n, const double* phi,
                                   const double* y, double* sum) {
  using Vector = typename Lanes<W>::Vector;
  Vector s[I][3] = {};
  for (std::size_t p = 0; p < n; ++p, phi += size.phi_stride, y += size.stride) {
    const Vector y0 = lanes_at<W>(y);
    const Vector y1 = lanes_at<W>(y + W);
    const Vector y2 = lanes_at<W>(y + 2 * W);
#pragma GCC unroll 5
    for (std::size_t i = 0; i < I; ++i) {
      s[i][0] += phi[i] * y0;
      s[i][1] += phi[i] * y1;
      s[i][2] += phi[i] * y2;
    }
  }
#pragma GCC unroll 5
  for (std::size_t i = 0; i < I; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double* to = sum + i * size.stride + j * W;
      put_lanes<W>(to, lanes_at<W>(to) + s[i][j]);
    }
  }
}

template <int W, std::size_t I>
MICROSLIP_INLINE void product_all(const ProductSizes& size, std::size_t n, const double* phi,
                                  const double* y, double* sum) {
  for (std::size_t j = 0; j < size.n_columns; j += 3 * W) {
    std::size_t i = 0;
    for (; i + I <= size.n_left; i += I) {
      product_tile<W, I>(size, n, phi + i, y + j, sum + i * size.stride + j);
    }
    for (; i < size.n_left; ++i) {
      product_tile<W, 1>(size, n, phi + i, y + j, sum + i * size.stride + j);
    }
  }
}

// NOLINTEND(modernize-avoid-c-arrays)

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
#define MICROSLIP_KERNELS(name, width, rows, attribute)                                          \
  struct name {                                                                                  \
    attribute static void spread(std::size_t n_signals, std::size_t n_modes, std::size_t n_rows, \
                                 const std::array<const double*, 3>& J,                          \
                                 const std::array<std::vector<double>, 3>& phi, double* y) {     \
      spread_all<Lanes<width>::Vector>(n_signals, n_modes, n_rows, J, phi, y);                   \
    }                                                                                            \
    attribute static void product(const ProductSizes& size, std::size_t n, const double* phi,    \
                                  const double* y, double* sum) {                                \
      product_all<width, rows>(size, n, phi, y, sum);                                            \
    }                                                                                            \
    static constexpr ProductKernels all{spread, product};                                        \
  };
// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, 2, 3, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, 4, 3, [[gnu::target("avx2,fma")]])
MICROSLIP_KERNELS(Avx512Kernels, 8, 5, [[gnu::target("avx512f,fma")]])
constexpr const ProductKernels* avx2 = &Avx2Kernels::all;
constexpr const ProductKernels* avx512 = &Avx512Kernels::all;
#else
constexpr const ProductKernels* avx2 = nullptr;
constexpr const ProductKernels* avx512 = nullptr;
#endif

}  // namespace

const ProductKernels& product_kernels() {
  static const ProductKernels& fastest = *runnable_kernels(PlainKernels::all, avx2, avx512).back();
  return fastest;
}

}  // namespace microslip::contact::sampled
