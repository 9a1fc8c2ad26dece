// Time integration against closed-form harmonic balance (H = 1) on random modal scenes (theory
// section 18; seeds 0 … 119, 2 % above the first mode). Each point of harmonic balance is where
// integration starts, so both speak of the same steady state.
//
//   Nothing changes state          linear: both are exact          |Δ| ≤ 1e-7
//   something slips or separates   H = 1 leaves out harmonics of relative size ε = ‖q_(2…5)‖/‖q_1‖,
//                                  which come back through the contact:  |Δ| ≤ 20 ε + 1e-6
//
// |Δ| is the largest difference of first-harmonic modal amplitudes over their size; 1e-7 is the
// periodicity tolerance, and 20 is three times the largest ratio |Δ|/ε met on these seeds (6.7):
// the gain from the harmonics left out to the first, large near a resonance. Scenes not periodic
// with the period of the excitation within the cap are left out and counted.

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "solver/time_integration.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip {
namespace {

constexpr double linear_tolerance = 1e-7;
constexpr double harmonic_gain = 20.0;
constexpr double nonlinear_floor = 1e-6;
constexpr int n_seeds = 120;

struct Comparison {
  double difference = 0.0;
  double higher = 0.0;  // ε
};

Comparison compare(const solver::Harmonics& balance, const solver::Harmonics& time) {
  const double size = time.rows().middleRows(1, 2).norm();
  return {(balance.rows().middleRows(1, 2) - time.rows().middleRows(1, 2)).norm() / size,
          time.rows().bottomRows(time.rows().rows() - 3).norm() / size};
}

TEST(TimeAgainstBalance, RandomScenesDifferByTheHarmonicsLeftOut) {
  int n_linear = 0;
  int n_nonlinear = 0;
  int n_weak = 0;
  int n_left_out = 0;
  double largest_linear = 0.0;
  double largest_gain = 0.0;
  double largest_weak = 0.0;
  for (std::uint64_t seed = 0; seed < n_seeds; ++seed) {
    tests::RandomScene random = tests::random_scene(seed);
    tests::add_transient(random.scene);
    const double frequency = 1.02 * random.scene.natural_frequency[0];
    const auto balance = solver::solve_at_frequency(random.scene, frequency, random.options);
    ASSERT_TRUE(balance.complete) << seed;
    solver::TimeOptions options;
    options.max_periods = 300;
    const auto point =
        solver::steady_state_from(random.scene, frequency, balance.points.front().q, options);
    if (point.period_multiple != 1) {
      ++n_left_out;
      continue;
    }
    const Comparison c = compare(balance.points.front().q, point.response.q);
    if (point.n_events == 0) {
      ++n_linear;
      largest_linear = std::max(largest_linear, c.difference);
      EXPECT_LT(c.difference, linear_tolerance) << seed;
      continue;
    }
    ++n_nonlinear;
    largest_gain = std::max(largest_gain, c.difference / c.higher);
    EXPECT_LT(c.difference, harmonic_gain * c.higher + nonlinear_floor) << seed;
    if (c.higher < 1e-3) {
      ++n_weak;
      largest_weak = std::max(largest_weak, c.difference);
    }
  }
  std::printf("%d linear scenes, largest difference %.1e\n", n_linear, largest_linear);
  std::printf("%d that slip or separate, largest difference %.1f times the harmonics left out\n",
              n_nonlinear, largest_gain);
  std::printf("%d of them with harmonics below 1e-3: largest difference %.1e\n", n_weak,
              largest_weak);
  std::printf("%d left out: not periodic within 300 periods\n", n_left_out);
  EXPECT_GE(n_linear + n_nonlinear, 50);
  EXPECT_GE(n_nonlinear, 30);
  EXPECT_GE(n_weak, 10);
}

}  // namespace
}  // namespace microslip
