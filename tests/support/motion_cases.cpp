#include "support/motion_cases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace microslip::test {
namespace {

using Random = std::mt19937_64;
using contact::Harmonics;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
double decades(Random& random, double low, double high) {
  return std::pow(10.0, uniform(random, low, high));
}
double sign(Random& random) { return uniform(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0; }
int integer(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

double size(const Harmonics& motion, int signal) {
  double sum = 0.0;
  for (int h = 1; h <= motion.n_harmonics(); ++h) {
    sum += std::hypot(motion.rows()(2 * h - 1, signal), motion.rows()(2 * h, signal));
  }
  return sum;
}

// Amplitudes that fall with h at a random rate, random phases.
void fill(Random& random, Harmonics& motion, int signal, double amplitude) {
  const double fall = uniform(random, 0.2, 1.3);
  double level = amplitude;
  for (int h = 1; h <= motion.n_harmonics(); ++h, level *= fall) {
    const double angle = uniform(random, -4.0, 4.0);
    motion.rows()(2 * h - 1, signal) = level * std::sin(angle);
    motion.rows()(2 * h, signal) = level * std::cos(angle);
  }
}

MotionCase drawn(Random& random, int n_harmonics, double spread) {
  MotionCase c{{}, Harmonics(n_harmonics, 3)};
  c.point.tangential_stiffness = decades(random, -spread, spread);
  c.point.normal_stiffness = decades(random, -spread, spread);
  c.point.friction_coefficient = decades(random, -1.0, 0.5);
  fill(random, c.motion, 0, decades(random, -spread, spread));
  const double spring = c.point.tangential_stiffness * size(c.motion, 0);
  fill(random, c.motion, 1,
       spring / (c.point.friction_coefficient * c.point.normal_stiffness) *
           decades(random, -spread, spread));
  fill(random, c.motion, 2, decades(random, -spread, spread));
  const double load = c.point.normal_stiffness * size(c.motion, 1);
  c.motion.rows()(0, 0) = uniform(random, -1.0, 1.0) * size(c.motion, 0);
  c.motion.rows()(0, 1) = uniform(random, -0.2, 0.2) * size(c.motion, 1);
  c.point.rest_load = uniform(random, -1.0, 1.0) * load;
  if (uniform(random, 0.0, 1.0) < 0.4) {
    c.point.rest_load += uniform(random, 0.0, 1.5) * spring / c.point.friction_coefficient;
  }
  return c;
}

MotionCase comparable(Random& random) { return drawn(random, integer(random, 1, 5), 0.3); }
MotionCase wide(Random& random) { return drawn(random, integer(random, 1, 4), 5.0); }
MotionCase many_harmonics(Random& random) { return drawn(random, integer(random, 7, 20), 0.5); }

// A fast ripple on a slow motion: many short phases.
MotionCase ripple(Random& random) {
  MotionCase c = drawn(random, integer(random, 6, 12), 0.3);
  const int last = 2 * c.motion.n_harmonics();
  for (int signal = 0; signal < 2; ++signal) {
    const double keep = c.motion.rows()(1, signal);
    c.motion.rows().col(signal).segment(3, last - 2) *= 1e-3;
    c.motion.rows()(last, signal) = keep * uniform(random, 0.01, 0.5);
  }
  return c;
}

MotionCase gap(Random& random) {
  MotionCase c = comparable(random);
  c.motion.rows()(0, 1) = 0.0;
  c.point.rest_load = -uniform(random, 0.0, 1.0) * c.point.normal_stiffness * size(c.motion, 1);
  return c;
}

MotionCase near_grazing(Random& random) {
  MotionCase c = comparable(random);
  c.motion.rows()(0, 1) = 0.0;
  c.point.rest_load = 0.0;
  const double lowest = smallest_load(c);
  c.point.rest_load = -lowest * (1.0 + sign(random) * decades(random, -16.5, -1.0));
  return c;
}

// Contact so short that it has hardly begun.
MotionCase barely_touching(Random& random) {
  MotionCase c = comparable(random);
  c.motion.rows()(0, 1) = 0.0;
  c.motion.rows().col(1) *= -1.0;
  c.point.rest_load = 0.0;
  const double highest = -smallest_load(c);
  c.motion.rows().col(1) *= -1.0;
  c.point.rest_load = -highest * (1.0 - decades(random, -12.0, -1.0));
  return c;
}

MotionCase constant_load(Random& random) {
  MotionCase c = comparable(random);
  c.point.rest_load = std::abs(c.point.rest_load);
  if (uniform(random, 0.0, 1.0) < 0.5) {
    c.point.normal_stiffness = 0.0;
  } else {
    c.motion.rows().col(1).tail(2 * c.motion.n_harmonics()).setZero();
  }
  return c;
}

// v in phase with u: one of the slip functions may vanish altogether.
MotionCase in_phase(Random& random) {
  MotionCase c = comparable(random);
  const double one =
      c.point.tangential_stiffness / (c.point.friction_coefficient * c.point.normal_stiffness);
  const double factors[] = {1.0, -1.0, 0.5, 2.0, -0.7};
  c.motion.rows().col(1) = (one * factors[integer(random, 0, 4)] * c.motion.rows().col(0)).eval();
  c.motion.rows()(0, 1) = 0.0;
  c.point.rest_load = uniform(random, -1.0, 2.0) * c.point.normal_stiffness * size(c.motion, 1);
  return c;
}

MotionCase zero_harmonics(Random& random) {
  MotionCase c = comparable(random);
  for (int h = 1; h <= c.motion.n_harmonics(); ++h) {
    for (int signal = 0; signal < 2; ++signal) {
      if (uniform(random, 0.0, 1.0) < 0.6) {
        c.motion.rows()(2 * h - 1, signal) = 0.0;
        c.motion.rows()(2 * h, signal) = 0.0;
      }
    }
  }
  return c;
}

MotionCase no_tangential_motion(Random& random) {
  MotionCase c = comparable(random);
  c.motion.rows().col(0).tail(2 * c.motion.n_harmonics()).setZero();
  return c;
}

MotionCase no_stiffness(Random& random) {
  MotionCase c = comparable(random);
  const int which = integer(random, 0, 3);
  if (which == 0 || which == 3) c.point.tangential_stiffness = 0.0;
  if (which == 1) c.point.friction_coefficient = 0.0;
  if (which == 2 || which == 3) c.point.normal_stiffness = 0.0;
  return c;
}

// Only multiples of one harmonic: the period repeats itself, every extremum is there several times.
MotionCase repeated(Random& random) {
  MotionCase c = drawn(random, 6, 0.3);
  const int step = integer(random, 2, 3);
  for (int h = 1; h <= 6; ++h) {
    if (h % step != 0) c.motion.rows().middleRows(2 * h - 1, 2).leftCols(2).setZero();
  }
  return c;
}

MotionCase tiny_and_large(Random& random) {
  MotionCase c = comparable(random);
  const double factor = decades(random, -100.0, 3.0);
  c.motion.rows() *= factor;
  c.point.rest_load *= factor;
  return c;
}

MotionCase loaded(Random& random) {
  MotionCase c = comparable(random);
  c.motion.rows()(0, 1) = 0.0;
  c.point.rest_load = 0.0;
  const double lowest = smallest_load(c);
  c.point.rest_load = -lowest * (1.0 + uniform(random, 0.0, 0.5)) +
                      uniform(random, 0.0, 1.5) * c.point.tangential_stiffness * size(c.motion, 0) /
                          c.point.friction_coefficient;
  return c;
}

}  // namespace

double normal_scale(const MotionCase& c) {
  const double k_v = c.point.normal_stiffness;
  return std::abs(c.point.rest_load + k_v * c.motion.rows()(0, 1)) + k_v * size(c.motion, 1);
}

double cycle_work(const Harmonics& motion, const Harmonics& force, Eigen::Index signal) {
  double sum = 0.0;
  for (int h = 1; h <= motion.n_harmonics(); ++h) {
    sum += h * (motion.sine(h)[signal] * force.cosine(h)[signal] -
                motion.cosine(h)[signal] * force.sine(h)[signal]);
  }
  return std::numbers::pi * sum;
}

double friction_scale(const MotionCase& c) {
  return c.point.tangential_stiffness * size(c.motion, 0) +
         c.point.friction_coefficient * normal_scale(c);
}

double smallest_load(const MotionCase& c) {
  const auto load = [&](double phase) {
    double value = c.motion.rows()(0, 1);
    for (int h = 1; h <= c.motion.n_harmonics(); ++h) {
      value += c.motion.rows()(2 * h - 1, 1) * std::sin(h * phase) +
               c.motion.rows()(2 * h, 1) * std::cos(h * phase);
    }
    return c.point.rest_load + c.point.normal_stiffness * value;
  };
  const int n = 64 * c.motion.n_harmonics();
  double best = 0.0;
  for (int i = 1; i < n; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / n;
    if (load(phase) < load(best)) best = phase;
  }
  for (double step = 2.0 * std::numbers::pi / n; step > 1e-10; step *= 0.5) {
    for (const double next : {best - step, best + step}) {
      if (load(next) < load(best)) best = next;
    }
  }
  return load(best);
}

MotionCase generic_motion(Random& random) {
  return drawn(random, integer(random, 1, 6), uniform(random, 0.0, 1.5));
}

const std::vector<MotionStratum>& motion_strata() {
  static const std::vector<MotionStratum> all{{"generic", generic_motion},
                                              {"comparable", comparable},
                                              {"wide", wide},
                                              {"many_harmonics", many_harmonics},
                                              {"ripple", ripple},
                                              {"loaded", loaded},
                                              {"gap", gap},
                                              {"near_grazing", near_grazing},
                                              {"barely_touching", barely_touching},
                                              {"constant_load", constant_load},
                                              {"in_phase", in_phase},
                                              {"zero_harmonics", zero_harmonics},
                                              {"no_tangential_motion", no_tangential_motion},
                                              {"no_stiffness", no_stiffness},
                                              {"repeated", repeated},
                                              {"tiny_and_large", tiny_and_large}};
  return all;
}

}  // namespace microslip::test
