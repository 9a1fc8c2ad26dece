#include "contact/lanes/line_kernels.hpp"

#include <limits>

#include "contact/lanes/pack.hpp"

namespace microslip::contact::sampled {
namespace {

// NOLINTBEGIN(modernize-avoid-c-arrays): a vector type loses its alignment as a template argument.

// Conditions are numbers of which the smaller or the larger is taken: masks that are combined are
// taken apart number by number by the compiler.

// Rows at a time, so that sums stay in registers: eight of them.
template <class Pack>
constexpr std::size_t tile = 8 / block_packs<Pack>;

template <class Pack, std::size_t N>
MICROSLIP_INLINE void synthesize_tile(std::size_t rows, const double* basis,
                                      const double* coefficients, double* values) {
  Pack sum[N][block_packs<Pack>] = {};
  for (std::size_t l = 0; l < rows; ++l) {
    for (std::size_t b = 0; b < block_packs<Pack>; ++b) {
      const Pack c = pack_at<Pack>(coefficients + l * block_size + b * pack_size<Pack>);
#pragma GCC unroll 4
      for (std::size_t i = 0; i < N; ++i) sum[i][b] += basis[i * rows + l] * c;
    }
  }
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t b = 0; b < block_packs<Pack>; ++b) {
      put_pack(values + i * block_size + b * pack_size<Pack>, sum[i][b]);
    }
  }
}

template <class Pack>
MICROSLIP_INLINE void synthesize_all(std::size_t n, std::size_t rows, const double* basis,
                                     const double* coefficients, double* values) {
  std::size_t i = 0;
  for (; i + tile<Pack> <= n; i += tile<Pack>) {
    synthesize_tile<Pack, tile<Pack>>(rows, basis + i * rows, coefficients,
                                      values + i * block_size);
  }
  for (; i < n; ++i) {
    synthesize_tile<Pack, 1>(rows, basis + i * rows, coefficients, values + i * block_size);
  }
}

template <class Pack, std::size_t N>
MICROSLIP_INLINE void analyze_tile(std::size_t n, std::size_t stride, const double* basis,
                                   const double* values, double* sums) {
  Pack sum[N][block_packs<Pack>] = {};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t b = 0; b < block_packs<Pack>; ++b) {
      const Pack f = pack_at<Pack>(values + i * block_size + b * pack_size<Pack>);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < N; ++k) sum[k][b] += basis[i * stride + k] * f;
    }
  }
  for (std::size_t k = 0; k < N; ++k) {
    for (std::size_t b = 0; b < block_packs<Pack>; ++b) {
      put_pack(sums + k * block_size + b * pack_size<Pack>, sum[k][b]);
    }
  }
}

template <class Pack>
MICROSLIP_INLINE void analyze_all(std::size_t n, std::size_t rows, std::size_t stride,
                                  const double* basis, const double* values, double* sums) {
  std::size_t k = 0;
  for (; k + tile<Pack> <= rows; k += tile<Pack>) {
    analyze_tile<Pack, tile<Pack>>(n, stride, basis + k, values, sums + k * block_size);
  }
  for (; k < rows; ++k) analyze_tile<Pack, 1>(n, stride, basis + k, values, sums + k * block_size);
}

template <class Pack>
MICROSLIP_INLINE void load_all(std::size_t n, const SmoothArrays& constants, const double* v,
                               double* closeness, double* normal, double* half_width) {
  for (std::size_t b = 0; b < block_size; b += pack_size<Pack>) {
    const Pack rest_load = pack_at<Pack>(constants.rest_load + b);
    const Pack stiffness = pack_at<Pack>(constants.normal_stiffness + b);
    const Pack ratio = pack_at<Pack>(constants.compliant_friction + b);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = i * block_size + b;
      const Pack r = rest_load + stiffness * pack_at<Pack>(v + at);
      const Pack load = larger(r, Pack{});
      put_pack(closeness + at, r);
      put_pack(normal + at, load);
      put_pack(half_width + at, ratio * load);
    }
  }
}

/// Between two instants, by what is there and by the slopes from their neighbours;
/// C¹ from one to the next.
template <class Pack>
struct Spline {
  Pack begin, slope, square, cube;

  MICROSLIP_INLINE static Spline through(const Pack& w0, const Pack& w1, const Pack& w2,
                                         const Pack& w3) {
    const Pack rise = w2 - w1;
    const Pack m1 = 0.5 * (w2 - w0);
    const Pack m2 = 0.5 * (w3 - w1);
    return {w1, m1, 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise};
  }
  [[nodiscard]] MICROSLIP_INLINE Pack at(const Pack& x) const {
    return begin + x * (slope + x * (square + x * cube));
  }
  [[nodiscard]] MICROSLIP_INLINE Pack slope_at(const Pack& x) const {
    return slope + x * (2.0 * square + 3.0 * x * cube);
  }
  /// Its own top is where the slope vanishes, if this is positive.
  [[nodiscard]] MICROSLIP_INLINE Pack discriminant() const {
    return square * square - 3.0 * slope * cube;
  }
  [[nodiscard]] MICROSLIP_INLINE Pack top() const {
    return slope / (root_of(larger(discriminant(), Pack{})) - square);
  }
};

/// Of the four places around the step that ends at an instant.
struct Places {
  std::size_t at[4];

  MICROSLIP_INLINE static Places of(std::size_t i, std::size_t n, std::size_t own) {
    return {{(i >= 2 ? i - 2 : i + n - 2) * block_size + own,
             (i >= 1 ? i - 1 : n - 1) * block_size + own, i * block_size + own,
             (i + 1 < n ? i + 1 : 0) * block_size + own}};
  }
  template <class Pack>
  [[nodiscard]] MICROSLIP_INLINE Spline<Pack> spline(const double* w) const {
    return Spline<Pack>::through(pack_at<Pack>(w + at[0]), pack_at<Pack>(w + at[1]),
                                 pack_at<Pack>(w + at[2]), pack_at<Pack>(w + at[3]));
  }
};

/// u + ratio r: an end of the band, which extended by r < 0 is smooth where contact opens and
/// closes.
template <class Pack>
MICROSLIP_INLINE Spline<Pack> end_of_band(const Spline<Pack>& u, const Spline<Pack>& r,
                                          const Pack& ratio) {
  return {u.begin + ratio * r.begin, u.slope + ratio * r.slope, u.square + ratio * r.square,
          u.cube + ratio * r.cube};
}

template <class Pack>
MICROSLIP_INLINE Spline<Pack> turned_over(const Spline<Pack>& w) {
  return {-w.begin, -w.slope, -w.square, -w.cube};
}

template <class Pack>
struct Top {
  Pack place;   // of the step; 2: none in it
  Pack height;  // there
};

/// In contact.
template <class Pack>
MICROSLIP_INLINE Top<Pack> top_of(const Spline<Pack>& w, const Spline<Pack>& r) {
  const Pack none = Pack{} + 2.0;
  const Pack end = w.slope_at(Pack{} + 1.0);
  const Pack top = w.top();
  const Pack x = larger(smaller(top, Pack{} + 1.0), Pack{});
  const Pack rises = w.slope > Pack{} ? x : none;
  const Pack falls = end < Pack{} ? x : none;
  // Where it turns twice within the step both ends rise or both fall.
  const Pack inside = smaller(top, Pack{} + 1.0 - top);
  const Pack alike = smaller(w.slope * end, w.discriminant());
  const Pack twice = smaller(inside, alike) > Pack{} ? x : none;
  const Pack holds = r.at(x) > Pack{} ? x : none;
  return {larger(smaller(larger(rises, falls), twice), holds), w.at(x)};
}

/// u where r rises through zero in the step.
template <class Pack>
MICROSLIP_INLINE Pack landing(const Spline<Pack>& u, const Spline<Pack>& r, const Pack& way) {
  const Pack one = Pack{} + 1.0;
  Pack x = -r.begin / way;
  for (int i = 0; i < 2; ++i) {
    x = x - r.at(x) / larger(r.slope_at(x), 0.25 * way);
    x = smaller(larger(x, Pack{}), one);
  }
  return u.at(x);
}

template <class Pack, bool touches>
MICROSLIP_INLINE void band_of(std::size_t n, const SmoothArrays& constants, const double* u,
                              const double* closeness, const double* half_width,
                              const TurningBand& band) {
  const Pack far = Pack{} + std::numeric_limits<double>::max();
  for (std::size_t b = 0; b < block_size; b += pack_size<Pack>) {
    const Pack ratio = pack_at<Pack>(constants.compliant_friction + b);
    for (std::size_t i = 0; i < n; ++i) {
      const Places places = Places::of(i, n, b);
      const std::size_t at = places.at[2];
      const Spline<Pack> position = places.spline<Pack>(u);
      const Spline<Pack> r = places.spline<Pack>(closeness);
      const Top<Pack> up = top_of(end_of_band(position, r, -ratio), r);
      const Top<Pack> down = top_of(turned_over(end_of_band(position, r, ratio)), r);
      const Pack here = pack_at<Pack>(u + at);
      const Pack g = pack_at<Pack>(half_width + at);
      const Pack up_turns = up.place < 1.5 ? Pack{} + 1.0 : Pack{};
      const Pack down_turns = down.place < 1.5 ? Pack{} + 2.0 : Pack{};
      const Pack both = up_turns + down_turns;
      const Pack later = smaller(both - 2.0, up.place - down.place);
      const Pack last = later > Pack{} ? Pack{} + 1.0 : Pack{};
      // Neither what is apart nor what never sticks turns.
      const Pack turn = g > Pack{} ? both + last : Pack{};
      const Pack w = turn == 2.0 ? -far : up.height;
      const Pack W = turn == 1.0 ? far : -down.height;
      put_pack(band.low + at, turn > Pack{} ? w : here - g);
      put_pack(band.high + at, turn > Pack{} ? W : here + g);
      put_pack(band.turns + at, turn);
      if constexpr (touches) {
        const Pack now = pack_at<Pack>(closeness + at);
        const Pack closes = smaller(now, r.begin <= Pack{} ? Pack{} + 1.0 : Pack{});
        put_pack(band.landed + at, closes > Pack{} ? landing(position, r, now - r.begin) : -far);
      }
    }
  }
}

template <class Pack>
MICROSLIP_INLINE void turning_band_all(std::size_t n, const SmoothArrays& constants,
                                       const double* u, const double* closeness,
                                       const double* half_width, const TurningBand& band,
                                       bool touches) {
  touches ? band_of<Pack, true>(n, constants, u, closeness, half_width, band)
          : band_of<Pack, false>(n, constants, u, closeness, half_width, band);
}

template <class Pack>
MICROSLIP_INLINE void friction_all(std::size_t n, const SmoothArrays& constants, const double* u,
                                   const double* slider, double* friction) {
  for (std::size_t b = 0; b < block_size; b += pack_size<Pack>) {
    const Pack stiffness = pack_at<Pack>(constants.tangential_stiffness + b);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = i * block_size + b;
      put_pack(friction + at, stiffness * (pack_at<Pack>(u + at) - pack_at<Pack>(slider + at)));
    }
  }
}

template <class Pack>
MICROSLIP_INLINE void range_all(std::size_t n, const double* values, double* least, double* most) {
  for (std::size_t b = 0; b < block_size; b += pack_size<Pack>) {
    Pack low = pack_at<Pack>(values + b);
    Pack high = low;
    for (std::size_t i = 1; i < n; ++i) {
      const Pack x = pack_at<Pack>(values + i * block_size + b);
      low = smaller(low, x);
      high = larger(high, x);
    }
    put_pack(least + b, low);
    put_pack(most + b, high);
  }
}

// What a pass through the period does besides (1).
struct Pass {
  bool touches;  // (2)
  bool turns;    // the band between instants
  bool last;     // what is kept
};

/// The slider before a step, of points that close in it where they do.
template <class Pack, bool turns>
MICROSLIP_INLINE Pack start_of_step(const LineArrays& a, std::size_t i, std::size_t own,
                                    const Pack& s) {
  const std::size_t at = i * block_size + own;
  if constexpr (turns) {
    const Pack landed = pack_at<Pack>(a.landed + at);
    return landed > Pack{} - std::numeric_limits<double>::max() ? landed : s;
  } else {
    const std::size_t before = (i > 0 ? i - 1 : a.n_instants - 1) * block_size + own;
    const Pack r0 = pack_at<Pack>(a.closeness + before);
    const Pack r = pack_at<Pack>(a.closeness + at);
    const Pack closes = smaller(r, r0 <= Pack{} ? Pack{} + 1.0 : Pack{});
    const Pack u0 = pack_at<Pack>(a.u + before);
    const Pack landed = u0 - r0 / (r - r0) * (pack_at<Pack>(a.u + at) - u0);
    return closes > Pack{} ? landed : s;
  }
}

template <class Pack>
MICROSLIP_INLINE Pack slip_state(const Pack& start, const Pack& low, const Pack& high) {
  const Pack positive = start < low ? Pack{} + 1.0 : Pack{};
  const Pack negative = start > high ? Pack{} + 2.0 : Pack{};
  return positive + negative;
}

template <class Pack, Pass kind>
MICROSLIP_INLINE void pass(const LineArrays& a, Pack* s) {
  for (std::size_t i = 0; i < a.n_instants; ++i) {
    for (std::size_t b = 0; b < block_packs<Pack>; ++b) {
      const std::size_t at = i * block_size + b * pack_size<Pack>;
      Pack start = s[b];
      if constexpr (kind.touches)
        start = start_of_step<Pack, kind.turns>(a, i, b * pack_size<Pack>, start);
      const Pack low = pack_at<Pack>(a.low + at);
      const Pack high = pack_at<Pack>(a.high + at);
      Pack state;
      if constexpr (kind.turns) {
        const Pack turn = pack_at<Pack>(a.turns + at);
        const Pack u = pack_at<Pack>(a.u + at);
        const Pack g = pack_at<Pack>(a.half_width + at);
        const Pack low_first = smaller(larger(start, low), high);
        const Pack high_first = larger(smaller(start, high), low);
        const Pack moved_on = turn > 3.5 ? high_first : low_first;
        const Pack turned = turn > Pack{} ? moved_on : start;
        s[b] = smaller(larger(turned, u - g), u + g);
        state = slip_state(turned, u - g, u + g);
        const Pack moved = turned != start ? Pack{} + 5.0 : Pack{};
        const Pack stays = state > Pack{} ? Pack{} : Pack{} + 5.0;
        state += smaller(moved, stays);
      } else {
        s[b] = smaller(larger(start, low), high);
        state = slip_state(start, low, high);
      }
      if constexpr (kind.last) {
        put_pack(a.state + at, pack_at<Pack>(a.closeness + at) > Pack{} ? state : Pack{} + 3.0);
        put_pack(a.slider + at, s[b]);
      }
    }
  }
}

template <class Pack, bool touches, bool turns>
MICROSLIP_INLINE void two_periods(const LineArrays& arrays) {
  Pack s[block_packs<Pack>] = {};
  pass<Pack, Pass{touches, turns, false}>(arrays, s);
  pass<Pack, Pass{touches, turns, true}>(arrays, s);
}

template <class Pack>
MICROSLIP_INLINE void march_all(const LineArrays& arrays, bool touches) {
  if (arrays.turns == nullptr) {
    touches ? two_periods<Pack, true, false>(arrays) : two_periods<Pack, false, false>(arrays);
  } else {
    touches ? two_periods<Pack, true, true>(arrays) : two_periods<Pack, false, true>(arrays);
  }
}

// NOLINTEND(modernize-avoid-c-arrays)

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
// The bodies above take on the target of the function they are inlined into.
#define MICROSLIP_KERNELS(name, width, attribute)                                                 \
  struct name {                                                                                   \
    using Pack = Lanes<width>::Vector;                                                            \
    attribute static void synthesize(std::size_t n, std::size_t rows, const double* basis,        \
                                     const double* c, double* values) {                           \
      synthesize_all<Pack>(n, rows, basis, c, values);                                            \
    }                                                                                             \
    attribute static void analyze(std::size_t n, std::size_t rows, std::size_t stride,            \
                                  const double* basis, const double* values, double* sums) {      \
      analyze_all<Pack>(n, rows, stride, basis, values, sums);                                    \
    }                                                                                             \
    attribute static void load(std::size_t n, const SmoothArrays& constants, const double* v,     \
                               double* closeness, double* normal, double* half_width) {           \
      load_all<Pack>(n, constants, v, closeness, normal, half_width);                             \
    }                                                                                             \
    attribute static void turning_band(std::size_t n, const SmoothArrays& constants,              \
                                       const double* u, const double* closeness,                  \
                                       const double* half_width, const TurningBand& band,         \
                                       bool touches) {                                            \
      turning_band_all<Pack>(n, constants, u, closeness, half_width, band, touches);              \
    }                                                                                             \
    attribute static void march(const LineArrays& arrays, bool touches) {                         \
      march_all<Pack>(arrays, touches);                                                           \
    }                                                                                             \
    attribute static void friction(std::size_t n, const SmoothArrays& constants, const double* u, \
                                   const double* slider, double* result) {                        \
      friction_all<Pack>(n, constants, u, slider, result);                                        \
    }                                                                                             \
    attribute static void range(std::size_t n, const double* values, double* least,               \
                                double* most) {                                                   \
      range_all<Pack>(n, values, least, most);                                                    \
    }                                                                                             \
    static constexpr LineKernels all{synthesize, analyze,  load, turning_band,                    \
                                     march,      friction, range};                                \
  };
// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, 2, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, 4, [[gnu::target("avx2,fma")]])
MICROSLIP_KERNELS(Avx512Kernels, 8, [[gnu::target("avx512f,fma")]])
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
