#include "contact/lanes/plane_kernels.hpp"

#include "contact/lanes/plane_turn.hpp"

namespace microslip::contact::sampled {
namespace {

enum class Task { march, record, linearise };

/// A point between two instants.
template <class Pack>
struct Moving {
  Pair<Pack> s;
  Pair<Pack> pull;  // η
  Pack slips;       // > 0 where it does
};

/// λ of (λ + W) e = b, |e| = 1: 1/|e(λ)| is concave and increasing,
/// Newton's method from below is monotone.
template <class Pack, bool equal>
MICROSLIP_INLINE Pair<Pack> settled_direction(const Pair<Pack>& b, const Pair<Pack>& W) {
  constexpr double smallest = 1e-290;
  constexpr int iterations = equal ? 0 : 8;
  const Pack size = larger(square_root(dot(b, b)), Pack{} + smallest);
  Pack lambda = larger(size - larger(W.p, W.r), Pack{});
  Pair<Pack> e = b;
  for (int i = 0; i < iterations; ++i) {
    const Pair<Pack> inverse = {1.0 / larger(lambda + W.p, smallest * size),
                                1.0 / larger(lambda + W.r, smallest * size)};
    e = times(inverse, b);
    const Pack square = dot(e, e);
    const Pack fall = dot(times(inverse, e), e);
    const Pack length = square_root(square);
    lambda += where(fall, (length - 1.0) * square / where(fall, fall, Pack{} + 1.0), Pack{});
  }
  const Pack length = larger(square_root(dot(e, e)), Pack{} + smallest);
  return (1.0 / length) * e;
}

/// ξ with |η₀ + ξ Δη| = 1, |η₀| ≤ 1 < |η₁|.
template <class Pack>
MICROSLIP_INLINE Pack onset_part(const Pair<Pack>& before, const Pair<Pack>& change) {
  const Pack a = dot(change, change);
  const Pack b = dot(before, change);
  const Pack c = smaller(dot(before, before) - 1.0, Pack{});
  const Pack root = square_root(b * b - a * c);
  const Pack divisor = where(b, b + root, a);
  const Pack part = where(b, -c, root - b) / where(divisor, divisor, Pack{} + 1.0);
  return smaller(part, Pack{} + 1.0);
}

/// Both ends of a step.
template <class Pack>
struct Ends {
  Pair<Pack> x0, x1;
  Pair<Pack> W0, W1;
  Pack r0, r1;
};

template <class Pack>
MICROSLIP_INLINE Ends<Pack> ends_of(const PlaneArrays& a, std::size_t then, std::size_t now) {
  return {{pack_at<Pack>(a.u + then), pack_at<Pack>(a.w + then)},
          {pack_at<Pack>(a.u + now), pack_at<Pack>(a.w + now)},
          {pack_at<Pack>(a.width_p + then), pack_at<Pack>(a.width_r + then)},
          {pack_at<Pack>(a.width_p + now), pack_at<Pack>(a.width_r + now)},
          pack_at<Pack>(a.closeness + then),
          pack_at<Pack>(a.closeness + now)};
}

/// Slip of the lanes where `slips` > 0: η at the end. @param pull  η₁ of a slider at rest.
template <class Pack, bool equal, Task task>
MICROSLIP_INLINE Pair<Pack> slip(const PlaneArrays& a, std::size_t now, double* turns,
                                 const Ends<Pack>& ends, const Moving<Pack>& before,
                                 const Pair<Pack>& pull, const Pack& touches, const Pack& slips) {
  const Pack goes_on = both(before.slips, dot(before.pull, pull) - 1.0);
  Pack part{};
  Pair<Pack> e = before.pull;
  if (any_above_zero(both(slips, opposite(larger(goes_on, touches))))) {
    const Pair<Pack> change = pull - before.pull;
    part = where(goes_on, Pack{}, onset_part(before.pull, change));
    const Pair<Pack> at_onset = before.pull + part * change;
    const Pack size = square_root(dot(at_onset, at_onset));
    e = (1.0 / where(size, size, Pack{} + 1.0)) * at_onset;
  }
  const SlipStep<Pack> step{e, (1.0 - part) * (ends.x1 - ends.x0),
                            ends.W0 + part * (ends.W1 - ends.W0), ends.W1};
  constexpr bool derivatives = task == Task::linearise;
  const TurnedStep<Pack> turn =
      equal ? turned_round<Pack, derivatives>(step) : turned_elliptic<Pack, derivatives>(step);
  if constexpr (task != Task::march) {
    const Pack begins = where(goes_on, Pack{}, Pack{} + 1.0);
    put_pack(a.entry + now, where(touches, Pack{} + 2.0, begins));
  }
  if constexpr (derivatives) {
    const auto put = [&](TurnNumber k, const Pack& value)
                         MICROSLIP_INLINE_LAMBDA { put_pack(turns + k * block_size, value); };
    put(by_angle, turn.by_angle);
    put(by_way_p, turn.by_way.p);
    put(by_way_r, turn.by_way.r);
    put(by_first_width_p, turn.by_first.p);
    put(by_first_width_r, turn.by_first.r);
    put(by_last_width_p, turn.by_last.p);
    put(by_last_width_r, turn.by_last.r);
    put(onset, part);
  }
  if (!any_above_zero(both(touches, slips))) return turn.e;
  const Pair<Pack> landed = settled_direction<Pack, equal>(times(ends.W1, pull), ends.W1);
  return where(touches, landed, turn.e);
}

template <class Pack, bool equal, Task task>
MICROSLIP_INLINE void one_step(const PlaneArrays& a, std::size_t then, std::size_t now,
                               double* turns, Moving<Pack>& point, Pack& ever) {
  const Ends<Pack> ends = ends_of<Pack>(a, then, now);
  const Pack touches = both(ends.r1, opposite(ends.r0));
  Pair<Pack> s = point.s;
  if (any_above_zero(touches)) {
    const Pack part = -ends.r0 / where(touches, ends.r1 - ends.r0, Pack{} + 1.0);
    s = where(touches, ends.x0 + part * (ends.x1 - ends.x0), s);
  }
  const Pair<Pack> inverse = {pack_at<Pack>(a.inverse_p + now), pack_at<Pack>(a.inverse_r + now)};
  Pair<Pack> pull = times(inverse, ends.x1 - s);
  const Pack slips = both(ends.r1, dot(pull, pull) - slip_edge);
  if (any_above_zero(slips)) {
    const Pair<Pack> e = slip<Pack, equal, task>(a, now, turns, ends, point, pull, touches, slips);
    pull = where(slips, e, pull);
    s = where(slips, ends.x1 - times(ends.W1, e), s);
    ever = where(slips, Pack{} + 1.0, ever);
  }
  point.s = where(ends.r1, s, ends.x1);
  point.pull = where(ends.r1, pull, Pair<Pack>{});
  point.slips = slips;
  if constexpr (task != Task::march) {
    put_pack(a.slider_p + now, point.s.p);
    put_pack(a.slider_r + now, point.s.r);
    put_pack(a.pull_p + now, point.pull.p);
    put_pack(a.pull_r + now, point.pull.r);
    put_pack(a.state + now, where(ends.r1, where(slips, Pack{} + 4.0, Pack{}), Pack{} + 3.0));
  }
}

template <class Pack, bool equal, Task task>
MICROSLIP_INLINE void pass(const PlaneArrays& a, double* state, double* ever) {
  for (std::size_t lane = 0; lane < block_size; lane += pack_size<Pack>) {
    const auto number = [&](std::size_t k) MICROSLIP_INLINE_LAMBDA {
      return pack_at<Pack>(state + k * block_size + lane);
    };
    const auto put = [&](std::size_t k, const Pack& value) MICROSLIP_INLINE_LAMBDA {
      put_pack(state + k * block_size + lane, value);
    };
    Moving<Pack> point{{number(0), number(1)}, {number(2), number(3)}, number(4)};
    Pack slips{};
    std::size_t then = lane;
    for (std::size_t i = 1; i <= a.n_instants; ++i) {
      const std::size_t at = i < a.n_instants ? i : 0;
      const std::size_t now = at * block_size + lane;
      one_step<Pack, equal, task>(a, then, now, a.turns + at * n_turn_numbers * block_size + lane,
                                  point, slips);
      then = now;
    }
    put(0, point.s.p);
    put(1, point.s.r);
    put(2, point.pull.p);
    put(3, point.pull.r);
    put(4, where(point.slips, Pack{} + 1.0, Pack{}));
    put_pack(ever + lane, slips);
  }
}

template <class Pack>
MICROSLIP_INLINE void start_all(const PlaneArrays& a, double* state) {
  for (std::size_t lane = 0; lane < block_size; lane += pack_size<Pack>) {
    const auto number = [&](std::size_t k) MICROSLIP_INLINE_LAMBDA {
      return pack_at<Pack>(state + k * block_size + lane);
    };
    const auto put = [&](std::size_t k, const Pack& value) MICROSLIP_INLINE_LAMBDA {
      put_pack(state + k * block_size + lane, value);
    };
    const Pair<Pack> x = {pack_at<Pack>(a.u + lane), pack_at<Pack>(a.w + lane)};
    const Pair<Pack> W = {pack_at<Pack>(a.width_p + lane), pack_at<Pack>(a.width_r + lane)};
    const Pair<Pack> inverse = {pack_at<Pack>(a.inverse_p + lane),
                                pack_at<Pack>(a.inverse_r + lane)};
    const Pack r = pack_at<Pack>(a.closeness + lane);
    Pair<Pack> s = {number(0), number(1)};
    Pair<Pack> pull = times(inverse, x - s);
    const Pack slips = both(r, dot(pull, pull) - slip_edge);
    const Pair<Pack> e = settled_direction<Pack, false>(times(W, pull), W);
    pull = where(slips, e, pull);
    s = where(slips, x - times(W, e), s);
    s = where(r, s, x);
    put(0, s.p);
    put(1, s.r);
    put(2, where(r, pull.p, Pack{}));
    put(3, where(r, pull.r, Pack{}));
    put(4, where(slips, Pack{} + 1.0, Pack{}));
  }
}

template <class Pack, Task task>
MICROSLIP_INLINE void pass_of(const PlaneArrays& a, bool equal, double* state, double* slips) {
  if (equal) {
    pass<Pack, true, task>(a, state, slips);
  } else {
    pass<Pack, false, task>(a, state, slips);
  }
}

template <class Pack>
MICROSLIP_INLINE void invert_all(std::size_t n, const double* values, double* inverse) {
  for (std::size_t at = 0; at < n * block_size; at += pack_size<Pack>) {
    const Pack x = pack_at<Pack>(values + at);
    put_pack(inverse + at, where(x, 1.0 / where(x, x, Pack{} + 1.0), Pack{}));
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
// The bodies above take on the target of the function they are inlined into.
#define MICROSLIP_KERNELS(name, width, attribute)                                                  \
  struct name {                                                                                    \
    using Pack = Lanes<width>::Vector;                                                             \
    attribute static void start(const PlaneArrays& a, double* state) {                             \
      start_all<Pack>(a, state);                                                                   \
    }                                                                                              \
    attribute static void march(const PlaneArrays& a, bool equal, double* state, double* slips) {  \
      pass_of<Pack, Task::march>(a, equal, state, slips);                                          \
    }                                                                                              \
    attribute static void record(const PlaneArrays& a, bool equal, double* state, double* slips) { \
      pass_of<Pack, Task::record>(a, equal, state, slips);                                         \
    }                                                                                              \
    attribute static void linearise(const PlaneArrays& a, bool equal, double* state,               \
                                    double* slips) {                                               \
      pass_of<Pack, Task::linearise>(a, equal, state, slips);                                      \
    }                                                                                              \
    attribute static void invert(std::size_t n, const double* values, double* inverse) {           \
      invert_all<Pack>(n, values, inverse);                                                        \
    }                                                                                              \
    static constexpr PlaneKernels all{start, march, record, linearise, invert};                    \
  };
// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, 2, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, 4, [[gnu::target("avx2,fma")]])
MICROSLIP_KERNELS(Avx512Kernels, 8, [[gnu::target("avx512f,fma")]])
constexpr const PlaneKernels* avx2 = &Avx2Kernels::all;
constexpr const PlaneKernels* avx512 = &Avx512Kernels::all;
#else
constexpr const PlaneKernels* avx2 = nullptr;
constexpr const PlaneKernels* avx512 = nullptr;
#endif

}  // namespace

std::vector<const PlaneKernels*> runnable_plane_kernels() {
  return runnable_kernels(PlainKernels::all, avx2, avx512);
}

const PlaneKernels& plane_kernels() {
  static const PlaneKernels& fastest = *runnable_plane_kernels().back();
  return fastest;
}

}  // namespace microslip::contact::sampled
