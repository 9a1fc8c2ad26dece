#include "contact/sampled/line_kernels.hpp"

#include "contact/sampled/pack.hpp"

namespace microslip::contact::sampled {
namespace {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector type loses its alignment as a template argument.

// Rows at a time, so that sums stay in registers.
constexpr std::size_t tile = 4;

template <std::size_t N>
MICROSLIP_INLINE void synthesize_tile(std::size_t rows, const double* basis,
                                      const double* coefficients, double* values) {
  Pack sum[N][block_packs] = {};
  for (std::size_t l = 0; l < rows; ++l) {
    for (std::size_t b = 0; b < block_packs; ++b) {
      const Pack c = pack_at(coefficients + l * block_size + b * pack_size);
#pragma GCC unroll 4
      for (std::size_t i = 0; i < N; ++i) sum[i][b] += basis[i * rows + l] * c;
    }
  }
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t b = 0; b < block_packs; ++b) {
      pack_at(values + i * block_size + b * pack_size) = sum[i][b];
    }
  }
}

MICROSLIP_INLINE void synthesize_all(std::size_t n, std::size_t rows, const double* basis,
                                     const double* coefficients, double* values) {
  std::size_t i = 0;
  for (; i + tile <= n; i += tile) {
    synthesize_tile<tile>(rows, basis + i * rows, coefficients, values + i * block_size);
  }
  for (; i < n; ++i) {
    synthesize_tile<1>(rows, basis + i * rows, coefficients, values + i * block_size);
  }
}

template <std::size_t N>
MICROSLIP_INLINE void analyze_tile(std::size_t n, std::size_t stride, const double* basis,
                                   const double* values, double* sums) {
  Pack sum[N][block_packs] = {};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t b = 0; b < block_packs; ++b) {
      const Pack f = pack_at(values + i * block_size + b * pack_size);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < N; ++k) sum[k][b] += basis[i * stride + k] * f;
    }
  }
  for (std::size_t k = 0; k < N; ++k) {
    for (std::size_t b = 0; b < block_packs; ++b) {
      pack_at(sums + k * block_size + b * pack_size) = sum[k][b];
    }
  }
}

MICROSLIP_INLINE void analyze_all(std::size_t n, std::size_t rows, std::size_t stride,
                                  const double* basis, const double* values, double* sums) {
  std::size_t k = 0;
  for (; k + tile <= rows; k += tile) {
    analyze_tile<tile>(n, stride, basis + k, values, sums + k * block_size);
  }
  for (; k < rows; ++k) analyze_tile<1>(n, stride, basis + k, values, sums + k * block_size);
}

MICROSLIP_INLINE void load_all(std::size_t n, const SmoothArrays& constants, const double* v,
                               double* closeness, double* normal, double* half_width) {
  for (std::size_t b = 0; b < block_size; b += pack_size) {
    const Pack preload = pack_at(constants.preload + b);
    const Pack stiffness = pack_at(constants.normal_stiffness + b);
    const Pack ratio = pack_at(constants.compliant_friction + b);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = i * block_size + b;
      const Pack r = preload + stiffness * pack_at(v + at);
      const Pack load = larger(r, Pack{});
      pack_at(closeness + at) = r;
      pack_at(normal + at) = load;
      pack_at(half_width + at) = ratio * load;
    }
  }
}

MICROSLIP_INLINE void friction_all(std::size_t n, const SmoothArrays& constants, const double* u,
                                   const double* slider, double* friction) {
  for (std::size_t b = 0; b < block_size; b += pack_size) {
    const Pack stiffness = pack_at(constants.tangential_stiffness + b);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = i * block_size + b;
      pack_at(friction + at) = stiffness * (pack_at(u + at) - pack_at(slider + at));
    }
  }
}

MICROSLIP_INLINE void range_all(std::size_t n, const double* values, double* least, double* most) {
  for (std::size_t b = 0; b < block_size; b += pack_size) {
    Pack low = pack_at(values + b);
    Pack high = low;
    for (std::size_t i = 1; i < n; ++i) {
      const Pack x = pack_at(values + i * block_size + b);
      low = smaller(low, x);
      high = larger(high, x);
    }
    pack_at(least + b) = low;
    pack_at(most + b) = high;
  }
}

MICROSLIP_INLINE void keep(const LineArrays& a, std::size_t at, const Pack& before, const Pack& low,
                           const Pack& high, const Pack& r, const Pack& s) {
  // One condition at a time: masks that are combined are taken apart number by number by the
  // compiler.
  const Pack positive = before < low ? Pack{} + 1.0 : Pack{};
  const Pack negative = before > high ? Pack{} + 2.0 : Pack{};
  const Pack slip = positive + negative;
  pack_at(a.state + at) = r > Pack{} ? slip : Pack{} + 3.0;
  pack_at(a.slider + at) = s;
}

template <bool touches, bool last>
MICROSLIP_INLINE void pass(const LineArrays& a, Pack* s) {
  const std::size_t end = (a.n_instants - 1) * block_size;
  std::size_t before = end;
  for (std::size_t at = 0; at <= end; before = at, at += block_size) {
    for (std::size_t b = 0; b < block_packs; ++b) {
      const std::size_t now = at + b * pack_size;
      const std::size_t then = before + b * pack_size;
      const Pack u = pack_at(a.u + now);
      const Pack r = pack_at(a.closeness + now);
      Pack start = s[b];
      if constexpr (touches) {
        const Pack u0 = pack_at(a.u + then);
        const Pack r0 = pack_at(a.closeness + then);
        const Pack landing = u0 - r0 / (r - r0) * (u - u0);
        const Pack closes = r0 <= Pack{} ? r : Pack{} - 1.0;
        start = closes > Pack{} ? landing : start;
      }
      const Pack g = pack_at(a.half_width + now);
      const Pack low = u - g;
      const Pack high = u + g;
      s[b] = smaller(larger(start, low), high);
      if constexpr (last) keep(a, now, start, low, high, r, s[b]);
    }
  }
}

MICROSLIP_INLINE void march_all(const LineArrays& arrays, bool touches) {
  Pack s[block_packs] = {};
  if (touches) {
    pass<true, false>(arrays, s);
    pass<true, true>(arrays, s);
  } else {
    pass<false, false>(arrays, s);
    pass<false, true>(arrays, s);
  }
}

// NOLINTEND(modernize-avoid-c-arrays)

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
// The bodies above take on the target of the function they are inlined into.
#define MICROSLIP_KERNELS(name, attribute)                                                        \
  struct name {                                                                                   \
    attribute static void synthesize(std::size_t n, std::size_t rows, const double* basis,        \
                                     const double* c, double* values) {                           \
      synthesize_all(n, rows, basis, c, values);                                                  \
    }                                                                                             \
    attribute static void analyze(std::size_t n, std::size_t rows, std::size_t stride,            \
                                  const double* basis, const double* values, double* sums) {      \
      analyze_all(n, rows, stride, basis, values, sums);                                          \
    }                                                                                             \
    attribute static void load(std::size_t n, const SmoothArrays& constants, const double* v,     \
                               double* closeness, double* normal, double* half_width) {           \
      load_all(n, constants, v, closeness, normal, half_width);                                   \
    }                                                                                             \
    attribute static void march(const LineArrays& arrays, bool touches) {                         \
      march_all(arrays, touches);                                                                 \
    }                                                                                             \
    attribute static void friction(std::size_t n, const SmoothArrays& constants, const double* u, \
                                   const double* slider, double* result) {                        \
      friction_all(n, constants, u, slider, result);                                              \
    }                                                                                             \
    attribute static void range(std::size_t n, const double* values, double* least,               \
                                double* most) {                                                   \
      range_all(n, values, least, most);                                                          \
    }                                                                                             \
    static constexpr LineKernels all{synthesize, analyze, load, march, friction, range};          \
  };
// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, [[gnu::target("avx2,fma")]])
MICROSLIP_KERNELS(Avx512Kernels, [[gnu::target("avx512f,fma")]])
constexpr const LineKernels* avx2 = &Avx2Kernels::all;
constexpr const LineKernels* avx512 = &Avx512Kernels::all;
#else
constexpr const LineKernels* avx2 = nullptr;
constexpr const LineKernels* avx512 = nullptr;
#endif

}  // namespace

std::vector<const LineKernels*> runnable_line_kernels() {
  return runnable_kernels(PlainKernels::all, avx2, avx512);
}

const LineKernels& line_kernels() {
  static const LineKernels& fastest = *runnable_line_kernels().back();
  return fastest;
}

}  // namespace microslip::contact::sampled
