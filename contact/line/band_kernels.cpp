#include "contact/line/band_kernels.hpp"

#include "contact/numerics/vector_lanes.hpp"

namespace microslip::contact {
namespace {

constexpr int W = 4;
using Vector = Lanes<W>::Vector;

struct SinesAndCosines {
  Vector sine;
  Vector cosine;
};

/// Of x by series: 1.3²¹/21! is 5e-18.
MICROSLIP_INLINE SinesAndCosines of_arc(const Vector& x) {
  const Vector y = x * x;
  Vector s = y * (-1.0 / 121645100408832000.0) + 1.0 / 355687428096000.0;
  s = y * s - 1.0 / 1307674368000.0;
  s = y * s + 1.0 / 6227020800.0;
  s = y * s - 1.0 / 39916800.0;
  s = y * s + 1.0 / 362880.0;
  s = y * s - 1.0 / 5040.0;
  s = y * s + 1.0 / 120.0;
  s = y * s - 1.0 / 6.0;
  Vector c = y * (1.0 / 2432902008176640000.0) - 1.0 / 6402373705728000.0;
  c = y * c + 1.0 / 20922789888000.0;
  c = y * c - 1.0 / 87178291200.0;
  c = y * c + 1.0 / 479001600.0;
  c = y * c - 1.0 / 3628800.0;
  c = y * c + 1.0 / 40320.0;
  c = y * c - 1.0 / 720.0;
  c = y * c + 1.0 / 24.0;
  c = y * c - 0.5;
  return {x + x * (y * s), y * c + 1.0};
}

/// Of the sum of two phases.
MICROSLIP_INLINE SinesAndCosines sum_of(const SinesAndCosines& a, const SinesAndCosines& b) {
  return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
}

MICROSLIP_INLINE SinesAndCosines spread(const SineAndCosine& phase) {
  const Vector zero{};
  return {zero + phase.sine, zero + phase.cosine};
}

MICROSLIP_INLINE void motion(const BandSeries& series, const SineAndCosine& middle, const double* x,
                             int n_basis, double* basis, BandMotion& now) {
  const double* const u = series.u;
  const double* const v = series.v;
  const int n = n_basis > series.n_harmonics ? n_basis : series.n_harmonics;
  for (int i = 0; i < n_band_nodes; i += W) {
    const SinesAndCosines first = sum_of(spread(middle), of_arc(lanes_at<W>(x + i)));
    SinesAndCosines at = first;
    Vector position{};
    Vector velocity{};
    Vector acceleration{};
    Vector approach = Vector{} + v[0];
    Vector approach_rate{};
    if (n_basis > 0) put_lanes<W>(basis + i, Vector{} + 1.0);
    for (int h = 1; h <= n; ++h) {
      if (h <= series.n_harmonics) {
        const double order = h;
        const Vector wave = u[2 * h - 1] * at.sine + u[2 * h] * at.cosine;
        position += wave;
        velocity += order * u[2 * h - 1] * at.cosine - order * u[2 * h] * at.sine;
        acceleration -= order * order * wave;
        approach += v[2 * h - 1] * at.sine + v[2 * h] * at.cosine;
        approach_rate += order * v[2 * h - 1] * at.cosine - order * v[2 * h] * at.sine;
      }
      if (h <= n_basis) {
        put_lanes<W>(basis + (2 * h - 1) * n_band_nodes + i, at.sine);
        put_lanes<W>(basis + 2 * h * n_band_nodes + i, at.cosine);
      }
      if (h < n) at = sum_of(at, first);
    }
    put_lanes<W>(now.position.data() + i, position);
    put_lanes<W>(now.velocity.data() + i, velocity);
    put_lanes<W>(now.acceleration.data() + i, acceleration);
    put_lanes<W>(now.approach.data() + i, approach);
    put_lanes<W>(now.approach_rate.data() + i, approach_rate);
  }
}

MICROSLIP_INLINE void layer(const double* rate, int n_harmonics, const SineAndCosine& anchor,
                            double velocity_there, const double* x, double* velocity) {
  for (int i = 0; i < n_band_nodes; i += W) {
    const SinesAndCosines half = of_arc(0.5 * lanes_at<W>(x + i));
    const SinesAndCosines middle = sum_of(spread(anchor), half);
    SinesAndCosines step = half;
    SinesAndCosines at = middle;
    Vector sum{};
    for (int h = 1; h <= n_harmonics; ++h) {
      sum += step.sine * (rate[2 * h - 1] * at.cosine - rate[2 * h] * at.sine);
      step = sum_of(step, half);
      at = sum_of(at, middle);
    }
    put_lanes<W>(velocity + i, velocity_there + 2.0 * sum);
  }
}

MICROSLIP_INLINE void sums(int n, int m, const double* basis, const double* weights, int stride,
                           double* sums) {
  static_assert(n_band_nodes == 3 * W);
  for (int k = 0; k < n; ++k, basis += n_band_nodes, sums += stride) {
    const Vector a = lanes_at<W>(basis);
    const Vector b = lanes_at<W>(basis + W);
    const Vector c = lanes_at<W>(basis + 2 * W);
    const double* w = weights;
    for (int j = 0; j < W * m; j += W) {
      Vector each[W];  // NOLINT(modernize-avoid-c-arrays)
#pragma GCC unroll 4
      for (int l = 0; l < W; ++l, w += n_band_nodes) {
        each[l] = a * lanes_at<W>(w) + b * lanes_at<W>(w + W) + c * lanes_at<W>(w + 2 * W);
      }
      Vector total;
#pragma GCC unroll 4
      for (int l = 0; l < W; ++l) total[l] = (each[l][0] + each[l][1]) + (each[l][2] + each[l][3]);
      put_lanes<W>(sums + j, lanes_at<W>(sums + j) + total);
    }
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
#define MICROSLIP_KERNELS(name, attribute)                                                   \
  struct name {                                                                              \
    attribute static void motion_at(const BandSeries& series, const SineAndCosine& middle,   \
                                    const double* x, int n_basis, double* basis,             \
                                    BandMotion& now) {                                       \
      motion(series, middle, x, n_basis, basis, now);                                        \
    }                                                                                        \
    attribute static void layer_at(const double* rate, int n_harmonics,                      \
                                   const SineAndCosine& anchor, double velocity_there,       \
                                   const double* x, double* velocity) {                      \
      layer(rate, n_harmonics, anchor, velocity_there, x, velocity);                         \
    }                                                                                        \
    attribute static void add_sums(int n, int m, const double* basis, const double* weights, \
                                   int stride, double* result) {                             \
      sums(n, m, basis, weights, stride, result);                                            \
    }                                                                                        \
    static constexpr BandKernels all{motion_at, layer_at, add_sums};                         \
  };
// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, [[gnu::target("avx2,fma")]])
constexpr const BandKernels* avx2 = &Avx2Kernels::all;
#else
constexpr const BandKernels* avx2 = nullptr;
#endif

}  // namespace

std::vector<const BandKernels*> runnable_band_kernels() {
  return runnable_kernels(PlainKernels::all, avx2, avx2);
}

const BandKernels& band_kernels() {
  static const BandKernels& fastest = *runnable_band_kernels().back();
  return fastest;
}

}  // namespace microslip::contact
