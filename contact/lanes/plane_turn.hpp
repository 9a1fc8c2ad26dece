/// @file
/// How slip turns the force within a step, in lanes: (2) and (3) of plane_kernels.hpp with their
/// derivatives (theory section 23.1).
#pragma once

#include "contact/lanes/pack.hpp"

namespace microslip::contact::sampled {

/// Along p and r.
template <class Pack>
struct Pair {
  Pack p;
  Pack r;
};

template <class Pack>
MICROSLIP_INLINE Pack dot(const Pair<Pack>& a, const Pair<Pack>& b) {
  return a.p * b.p + a.r * b.r;
}
/// Turned by a right angle, p towards r.
template <class Pack>
MICROSLIP_INLINE Pair<Pack> across(const Pair<Pack>& a) {
  return {-a.r, a.p};
}
template <class Pack>
MICROSLIP_INLINE Pair<Pack> operator+(const Pair<Pack>& a, const Pair<Pack>& b) {
  return {a.p + b.p, a.r + b.r};
}
template <class Pack>
MICROSLIP_INLINE Pair<Pack> operator-(const Pair<Pack>& a, const Pair<Pack>& b) {
  return {a.p - b.p, a.r - b.r};
}
template <class Pack>
MICROSLIP_INLINE Pair<Pack> operator*(const Pack& a, const Pair<Pack>& b) {
  return {a * b.p, a * b.r};
}
template <class Pack>
MICROSLIP_INLINE Pair<Pack> times(const Pair<Pack>& a, const Pair<Pack>& b) {
  return {a.p * b.p, a.r * b.r};
}
/// a where `test` > 0, else b.
template <class Pack>
MICROSLIP_INLINE Pack where(const Pack& test, const Pack& a, const Pack& b) {
  return test > Pack{} ? a : b;
}
template <class Pack>
MICROSLIP_INLINE Pair<Pack> where(const Pack& test, const Pair<Pack>& a, const Pair<Pack>& b) {
  return {where(test, a.p, b.p), where(test, a.r, b.r)};
}
/// > 0 where both are. Conditions are numbers and joined as such: masks of masks are taken apart
/// lane by lane by the compiler.
template <class Pack>
MICROSLIP_INLINE Pack both(const Pack& a, const Pack& b) {
  return smaller(a, b);
}
/// > 0 where a is not.
template <class Pack>
MICROSLIP_INLINE Pack opposite(const Pack& a) {
  return 1e-300 - a;
}
template <class Pack>
MICROSLIP_INLINE bool any_above_zero(const Pack& x) {
  if constexpr (pack_size<Pack> == 2) {
    return x[0] > 0.0 || x[1] > 0.0;
  } else if constexpr (pack_size<Pack> == 4) {
    return any_above_zero(
        larger(__builtin_shufflevector(x, x, 0, 1), __builtin_shufflevector(x, x, 2, 3)));
  } else {
    return any_above_zero(larger(__builtin_shufflevector(x, x, 0, 1, 2, 3),
                                 __builtin_shufflevector(x, x, 4, 5, 6, 7)));
  }
}
/// 0 where a is not positive.
template <class Pack>
MICROSLIP_INLINE Pack square_root(const Pack& a) {
  return root_of(larger(a, Pack{}));
}

/// e₁ of (3) and its derivatives by α₀, d and c.
template <class Pack>
struct Turned {
  Pair<Pack> e;
  Pack by_angle;
  Pair<Pack> by_way;
  Pack by_width;
};

template <class Pack, bool derivatives>
MICROSLIP_INLINE Turned<Pack> turned(const Pair<Pack>& e, const Pair<Pack>& d, const Pack& c) {
  // Ways shorter than any turn nothing; a longer z leaves nothing of the angle.
  constexpr double shortest = 1e-290;
  constexpr double longest = 1e9;
  const Pack square = dot(d, d);
  const Pack moves = square - shortest;
  const Pack length = square_root(where(moves, square, Pack{} + 1.0));
  const Pack width = larger(c, length * (1.0 / longest));
  const Pack inverse = 1.0 / (length * width);
  const Pack by_length = inverse * width;
  const Pack z = length * length * inverse;
  const Pair<Pack> m = by_length * d;
  const Pack P = 1.0 + z * (1.0 + z * (0.5 + z * (1.0 / 6.0)));
  const Pack along = dot(e, m);
  const Pack aside = e.p * m.r - e.r * m.p;
  const Pack front = (1.0 + along) * P * P;
  const Pack back = 1.0 - along;
  const Pack part = 1.0 / (front + back);
  const Pack cosine = (front - back) * part;
  const Pack sine = 2.0 * aside * P * part;
  Turned<Pack> result;
  result.e = where(moves, {cosine * m.p + sine * m.r, cosine * m.r - sine * m.p}, e);
  if constexpr (derivatives) {
    const Pack by_width = inverse * length;
    const Pack rate = where(moves, sine * (1.0 + z * (1.0 + 0.5 * z)) / P * by_width, Pack{});
    const Pack kept = where(moves, 2.0 * P * part, Pack{} + 1.0);
    result.by_angle = kept;
    result.by_way = ((1.0 - kept) * by_length) * across(m) + rate * m;
    result.by_width = -rate * z;
  }
  return result;
}

/// What a step of slip begins and ends with.
template <class Pack>
struct SlipStep {
  Pair<Pack> e;
  Pair<Pack> way;    // Δx
  Pair<Pack> first;  // W
  Pair<Pack> last;
};

/// e₁ and its derivatives by all of a step.
template <class Pack>
struct TurnedStep {
  Pair<Pack> e;
  Pack by_angle;
  Pair<Pack> by_way;
  Pair<Pack> by_first;
  Pair<Pack> by_last;
};

template <class Pack, bool derivatives>
MICROSLIP_INLINE TurnedStep<Pack> turned_round(const SlipStep<Pack>& step) {
  const Turned<Pack> turn =
      turned<Pack, derivatives>(step.e, step.way, 0.5 * (step.first.p + step.last.p));
  TurnedStep<Pack> result;
  result.e = turn.e;
  if constexpr (derivatives) {
    result.by_angle = turn.by_angle;
    result.by_way = turn.by_way;
    result.by_first = result.by_last = {0.5 * turn.by_width, Pack{}};
  }
  return result;
}

/// d and c at a direction e with the share of the way, and their derivatives by its angle.
template <class Pack>
struct Drive {
  Pair<Pack> d;
  Pack c;
  Pair<Pack> d_by_angle;
  Pack c_by_angle;
};

template <class Pack>
MICROSLIP_INLINE Drive<Pack> drive_at(const Pair<Pack>& e, const Pair<Pack>& way,
                                      const Pair<Pack>& rise, const Pair<Pack>& mean,
                                      double share) {
  const Pack difference = share * (rise.r - rise.p);
  const Pack product = e.p * e.r;
  const Pack q = product * difference;
  const Pack q_by_angle = (e.p * e.p - e.r * e.r) * difference;
  Drive<Pack> drive;
  drive.d = (Pack{} + share) * way - q * across(e);
  drive.c = e.r * e.r * mean.p + e.p * e.p * mean.r;
  drive.d_by_angle = q * e - q_by_angle * across(e);
  drive.c_by_angle = 2.0 * product * (mean.p - mean.r);
  return drive;
}

template <class Pack, bool derivatives>
MICROSLIP_INLINE TurnedStep<Pack> turned_elliptic(const SlipStep<Pack>& step) {
  const Pair<Pack> rise = step.last - step.first;
  const Pair<Pack> mean = {0.5 * (step.first.p + step.last.p), 0.5 * (step.first.r + step.last.r)};
  const Drive<Pack> begin = drive_at(step.e, step.way, rise, mean, 0.5);
  const Turned<Pack> half = turned<Pack, derivatives>(step.e, begin.d, begin.c);
  const Pair<Pack>& middle = half.e;
  const Drive<Pack> centre = drive_at(middle, step.way, rise, mean, 1.0);
  const Turned<Pack> whole = turned<Pack, derivatives>(step.e, centre.d, centre.c);
  TurnedStep<Pack> result;
  result.e = whole.e;
  if constexpr (derivatives) {
    const Pack by_middle =
        dot(whole.by_way, centre.d_by_angle) + whole.by_width * centre.c_by_angle;
    const Pack middle_by_angle =
        half.by_angle + dot(half.by_way, begin.d_by_angle) + half.by_width * begin.c_by_angle;
    result.by_angle = whole.by_angle + by_middle * middle_by_angle;
    result.by_way = whole.by_way + (0.5 * by_middle) * half.by_way;
    const Pack by_difference =
        -middle.p * middle.r * dot(whole.by_way, across(middle)) -
        by_middle * 0.5 * step.e.p * step.e.r * dot(half.by_way, across(step.e));
    const Pack part = 0.5 * by_middle * half.by_width;
    const Pair<Pack> by_mean = {
        0.5 * whole.by_width * middle.r * middle.r + part * step.e.r * step.e.r,
        0.5 * whole.by_width * middle.p * middle.p + part * step.e.p * step.e.p};
    result.by_first = {by_mean.p + by_difference, by_mean.r - by_difference};
    result.by_last = {by_mean.p - by_difference, by_mean.r + by_difference};
  }
  return result;
}

}  // namespace microslip::contact::sampled
