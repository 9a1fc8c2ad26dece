#include "contact/lanes/plane_kernels.hpp"

#include "contact/lanes/plane_turn.hpp"

namespace microslip::contact::sampled {
namespace {

enum class Task { march, record, linearise };

/// A point between two instants.
struct Moving {
  Pair s;
  Pair pull;   // η
  Pack slips;  // > 0 where it does
};

/// λ of (λ + W) e = b, |e| = 1: 1/|e(λ)| is concave and increasing,
/// Newton's method from below is monotone.
template <bool equal>
MICROSLIP_INLINE Pair settled_direction(const Pair& b, const Pair& W) {
  constexpr double smallest = 1e-290;
  constexpr int iterations = equal ? 0 : 8;
  const Pack size = larger(square_root(dot(b, b)), Pack{} + smallest);
  Pack lambda = larger(size - larger(W.p, W.r), Pack{});
  Pair e = b;
  for (int i = 0; i < iterations; ++i) {
    const Pair inverse = {1.0 / larger(lambda + W.p, smallest * size),
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
MICROSLIP_INLINE Pack onset_part(const Pair& before, const Pair& change) {
  const Pack a = dot(change, change);
  const Pack b = dot(before, change);
  const Pack c = smaller(dot(before, before) - 1.0, Pack{});
  const Pack root = square_root(b * b - a * c);
  const Pack divisor = where(b, b + root, a);
  const Pack part = where(b, -c, root - b) / where(divisor, divisor, Pack{} + 1.0);
  return smaller(part, Pack{} + 1.0);
}

/// Both ends of a step.
struct Ends {
  Pair x0, x1;
  Pair W0, W1;
  Pack r0, r1;
};

MICROSLIP_INLINE Ends ends_of(const PlaneArrays& a, std::size_t then, std::size_t now) {
  return {{pack_at(a.u + then), pack_at(a.w + then)},
          {pack_at(a.u + now), pack_at(a.w + now)},
          {pack_at(a.width_p + then), pack_at(a.width_r + then)},
          {pack_at(a.width_p + now), pack_at(a.width_r + now)},
          pack_at(a.closeness + then),
          pack_at(a.closeness + now)};
}

/// Slip of the lanes where `slips` > 0: η at the end. @param pull  η₁ of a slider at rest.
template <bool equal, Task task>
MICROSLIP_INLINE Pair slip(const PlaneArrays& a, std::size_t now, double* turns, const Ends& ends,
                           const Moving& before, const Pair& pull, const Pack& touches,
                           const Pack& slips) {
  const Pack goes_on = both(before.slips, dot(before.pull, pull) - 1.0);
  Pack part{};
  Pair e = before.pull;
  if (any_above_zero(both(slips, opposite(larger(goes_on, touches))))) {
    const Pair change = pull - before.pull;
    part = where(goes_on, Pack{}, onset_part(before.pull, change));
    const Pair at_onset = before.pull + part * change;
    const Pack size = square_root(dot(at_onset, at_onset));
    e = (1.0 / where(size, size, Pack{} + 1.0)) * at_onset;
  }
  const SlipStep step{e, (1.0 - part) * (ends.x1 - ends.x0), ends.W0 + part * (ends.W1 - ends.W0),
                      ends.W1};
  constexpr bool derivatives = task == Task::linearise;
  const TurnedStep turn =
      equal ? turned_round<derivatives>(step) : turned_elliptic<derivatives>(step);
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
  const Pair landed = settled_direction<equal>(times(ends.W1, pull), ends.W1);
  return where(touches, landed, turn.e);
}

template <bool equal, Task task>
MICROSLIP_INLINE void one_step(const PlaneArrays& a, std::size_t then, std::size_t now,
                               double* turns, Moving& point, Pack& ever) {
  const Ends ends = ends_of(a, then, now);
  const Pack touches = both(ends.r1, opposite(ends.r0));
  Pair s = point.s;
  if (any_above_zero(touches)) {
    const Pack part = -ends.r0 / where(touches, ends.r1 - ends.r0, Pack{} + 1.0);
    s = where(touches, ends.x0 + part * (ends.x1 - ends.x0), s);
  }
  const Pair inverse = {pack_at(a.inverse_p + now), pack_at(a.inverse_r + now)};
  Pair pull = times(inverse, ends.x1 - s);
  const Pack slips = both(ends.r1, dot(pull, pull) - slip_edge);
  if (any_above_zero(slips)) {
    const Pair e = slip<equal, task>(a, now, turns, ends, point, pull, touches, slips);
    pull = where(slips, e, pull);
    s = where(slips, ends.x1 - times(ends.W1, e), s);
    ever = where(slips, Pack{} + 1.0, ever);
  }
  point.s = where(ends.r1, s, ends.x1);
  point.pull = where(ends.r1, pull, Pair{});
  point.slips = slips;
  if constexpr (task != Task::march) {
    put_pack(a.slider_p + now, point.s.p);
    put_pack(a.slider_r + now, point.s.r);
    put_pack(a.pull_p + now, point.pull.p);
    put_pack(a.pull_r + now, point.pull.r);
    put_pack(a.state + now, where(ends.r1, where(slips, Pack{} + 4.0, Pack{}), Pack{} + 3.0));
  }
}

template <bool equal, Task task>
MICROSLIP_INLINE void pass(const PlaneArrays& a, double* state, double* ever) {
  for (std::size_t lane = 0; lane < block_size; lane += pack_size) {
    const auto number = [&](std::size_t k) MICROSLIP_INLINE_LAMBDA {
      return pack_at(state + k * block_size + lane);
    };
    const auto put = [&](std::size_t k, const Pack& value) MICROSLIP_INLINE_LAMBDA {
      put_pack(state + k * block_size + lane, value);
    };
    Moving point{{number(0), number(1)}, {number(2), number(3)}, number(4)};
    Pack slips{};
    std::size_t then = lane;
    for (std::size_t i = 1; i <= a.n_instants; ++i) {
      const std::size_t at = i < a.n_instants ? i : 0;
      const std::size_t now = at * block_size + lane;
      one_step<equal, task>(a, then, now, a.turns + at * n_turn_numbers * block_size + lane, point,
                            slips);
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

MICROSLIP_INLINE void start_all(const PlaneArrays& a, double* state) {
  for (std::size_t lane = 0; lane < block_size; lane += pack_size) {
    const auto number = [&](std::size_t k) MICROSLIP_INLINE_LAMBDA {
      return pack_at(state + k * block_size + lane);
    };
    const auto put = [&](std::size_t k, const Pack& value) MICROSLIP_INLINE_LAMBDA {
      put_pack(state + k * block_size + lane, value);
    };
    const Pair x = {pack_at(a.u + lane), pack_at(a.w + lane)};
    const Pair W = {pack_at(a.width_p + lane), pack_at(a.width_r + lane)};
    const Pair inverse = {pack_at(a.inverse_p + lane), pack_at(a.inverse_r + lane)};
    const Pack r = pack_at(a.closeness + lane);
    Pair s = {number(0), number(1)};
    Pair pull = times(inverse, x - s);
    const Pack slips = both(r, dot(pull, pull) - slip_edge);
    const Pair e = settled_direction<false>(times(W, pull), W);
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

template <Task task>
MICROSLIP_INLINE void pass_of(const PlaneArrays& a, bool equal, double* state, double* slips) {
  if (equal) {
    pass<true, task>(a, state, slips);
  } else {
    pass<false, task>(a, state, slips);
  }
}

MICROSLIP_INLINE void invert_all(std::size_t n, const double* values, double* inverse) {
  for (std::size_t at = 0; at < n * block_size; at += pack_size) {
    const Pack x = pack_at(values + at);
    put_pack(inverse + at, where(x, 1.0 / where(x, x, Pack{} + 1.0), Pack{}));
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): an attribute cannot stand in parentheses.
// The bodies above take on the target of the function they are inlined into.
#define MICROSLIP_KERNELS(name, attribute)                                                         \
  struct name {                                                                                    \
    attribute static void start(const PlaneArrays& a, double* state) { start_all(a, state); }      \
    attribute static void march(const PlaneArrays& a, bool equal, double* state, double* slips) {  \
      pass_of<Task::march>(a, equal, state, slips);                                                \
    }                                                                                              \
    attribute static void record(const PlaneArrays& a, bool equal, double* state, double* slips) { \
      pass_of<Task::record>(a, equal, state, slips);                                               \
    }                                                                                              \
    attribute static void linearise(const PlaneArrays& a, bool equal, double* state,               \
                                    double* slips) {                                               \
      pass_of<Task::linearise>(a, equal, state, slips);                                            \
    }                                                                                              \
    attribute static void invert(std::size_t n, const double* values, double* inverse) {           \
      invert_all(n, values, inverse);                                                              \
    }                                                                                              \
    static constexpr PlaneKernels all{start, march, record, linearise, invert};                    \
  };
// NOLINTEND(bugprone-macro-parentheses)

MICROSLIP_KERNELS(PlainKernels, )
#if defined(__x86_64__)
MICROSLIP_KERNELS(Avx2Kernels, [[gnu::target("avx2,fma")]])
MICROSLIP_KERNELS(Avx512Kernels, [[gnu::target("avx512f,fma")]])
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
