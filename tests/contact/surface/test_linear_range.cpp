#include "contact/surface/linear_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "contact/harmonics.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::test_linear_range {
namespace {

SleepState state_of(const LinearRange& range, const Harmonics& u, const Harmonics& v,
                    const Harmonics& w, const LinearReserve& reserve = {}) {
  const PhaseTable table(u.n_harmonics());
  return sleep_state(range, {u.rows().data(), v.rows().data(), w.rows().data()}, table, 1.0,
                     reserve);
}

Harmonics random_signal(int n_harmonics, double size, std::mt19937_64& random) {
  std::normal_distribution<double> g(0.0, size);
  Harmonics y(n_harmonics, 1);
  for (double& x : y.vector()) x = g(random);
  return y;
}

// max over the period of what (1) forbids: |K x| − μ n where pressed, n where open.
double worst(const LinearRange& r, const Harmonics& u, const Harmonics& v, const Harmonics& w,
             bool open) {
  double worst = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < 1000; ++j) {
    const double phase = 2.0 * std::numbers::pi * j / 1000.0;
    const double n = r.rest_load + r.stiffness[1] * v.at(phase)[0];
    const double f = std::hypot(r.stiffness[0] * u.at(phase)[0], r.stiffness[2] * w.at(phase)[0]);
    worst = std::max(worst, open ? n : f - r.friction.at_rest() * n);
  }
  return worst;
}

// Against 1 000 phases: what is proved holds, and what holds with 2 % to spare is proved.
TEST(LinearRange, ProofIsSoundAndSharp) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u01(0.0, 1.0);
  int n_stuck = 0;
  int n_open = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const int H = 1 + trial % 5;
    const LinearRange range{{u01(random), u01(random), trial % 2 == 0 ? 0.0 : u01(random)},
                            8.0 * u01(random) - 4.0,
                            FrictionLaw::constant(0.1 + u01(random))};
    const Harmonics u = random_signal(H, 0.6, random);
    const Harmonics v = random_signal(H, 0.6, random);
    const Harmonics w = random_signal(H, 0.6, random);
    const SleepState state = state_of(range, u, v, w);
    const bool open = range.rest_load + range.stiffness[1] * v.rows()(0, 0) < 0.0;
    const double excess = worst(range, u, v, w, open);
    n_stuck += state == SleepState::stuck ? 1 : 0;
    n_open += state == SleepState::open ? 1 : 0;
    if (state != SleepState::awake) {
      ASSERT_LT(excess, 0.0);
      ASSERT_EQ(state, open ? SleepState::open : SleepState::stuck);
    } else {
      // (2) with amplitudes of size one.
      const double amplitudes = range.stiffness[0] * u.vector().cwiseAbs().sum() +
                                range.stiffness[2] * w.vector().cwiseAbs().sum() +
                                range.stiffness[1] * v.vector().cwiseAbs().sum();
      ASSERT_GT(excess, -0.02 * amplitudes);
    }
  }
  EXPECT_GT(n_stuck, 100);
  EXPECT_GT(n_open, 100);
}

TEST(LinearRange, NothingSleepsAtALimit) {
  const Harmonics none(1, 1);
  Harmonics sine(1, 1);
  sine.rows() << 0.0, 1.0, 0.0;
  const FrictionLaw half = FrictionLaw::constant(0.5);
  EXPECT_EQ(state_of({{1, 1, 1}, 0.0, half}, none, none, none), SleepState::awake);
  EXPECT_EQ(state_of({{0, 1, 0}, 1.0, half}, none, sine, none), SleepState::awake);  // n₀ = B
  EXPECT_EQ(state_of({{0, 1, 0}, -1.0, half}, none, sine, none), SleepState::awake);
  EXPECT_EQ(state_of({{1, 0, 1}, 2.0, half}, sine, none, none), SleepState::awake);  // k_u a = μ n₀
  EXPECT_EQ(state_of({{1, 0, 1}, 2.0 + 1e-9, half}, sine, none, none), SleepState::stuck);
  EXPECT_EQ(state_of({{1, 0, 1}, 2.0 + 1e-9, half, false}, sine, none, none), SleepState::awake);
  // A mean force at the end of its interval.
  Harmonics dragged = sine;
  dragged.rows()(0, 0) = 1.0;
  EXPECT_EQ(state_of({{1, 0, 1}, 4.0 - 1e-9, half}, dragged, none, none), SleepState::awake);
  EXPECT_EQ(state_of({{1, 0, 1}, 4.0 + 1e-9, half}, dragged, none, none), SleepState::stuck);
}

// In phase, the load is high where the force is.
TEST(LinearRange, KnowsThatLoadAndForceMoveTogether) {
  Harmonics sine(1, 1);
  sine.rows() << 0.0, 1.0, 0.0;
  Harmonics turned(1, 1);
  turned.rows() << 0.0, 0.0, 1.0;
  const Harmonics none(1, 1);
  // |1.5 sin θ| ≤ 0.5 (4 + 2 cos θ) throughout; amplitudes add up to 2.5 > 2.
  EXPECT_EQ(state_of({{1.5, 2.0, 0.0}, 4.0, FrictionLaw::constant(0.5)}, sine, turned, none),
            SleepState::stuck);
}

TEST(LinearRange, HoldsAtEverySizeOfItsUnits) {
  const tests::UntrappedFloatingPoint nan_is_compared;
  Harmonics sine(1, 1);
  for (const double unit : {1e-300, 1e-200, 1e-150, 1.0, 1e150, 1e200, 1e300}) {
    sine.rows() << 0.0, unit, 0.0;
    const Harmonics none(1, 1);
    const FrictionLaw half = FrictionLaw::constant(0.5);
    EXPECT_EQ(state_of({{1, 1, 1}, 2.1 * unit, half}, sine, none, sine), SleepState::awake) << unit;
    EXPECT_EQ(state_of({{1, 1, 1}, 2.1 * unit, half}, sine, none, none), SleepState::stuck) << unit;
    EXPECT_EQ(state_of({{1, 1, 1}, -1.1 * unit, half}, none, sine, none), SleepState::open) << unit;
    EXPECT_EQ(state_of({{1, 1, 1}, -0.9 * unit, half}, none, sine, none), SleepState::awake)
        << unit;
  }
  sine.rows() << 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0;
  EXPECT_EQ(state_of({{1, 1, 1}, 9.0, FrictionLaw::constant(0.5)}, sine, sine, sine),
            SleepState::awake);
}

TEST(LinearRange, ReserveIsLeftOver) {
  Harmonics sine(1, 1);
  sine.rows() << 0.0, 1.0, 0.0;
  const Harmonics none(1, 1);
  const LinearRange range{{1, 0, 0}, 4.0, FrictionLaw::constant(0.5)};
  EXPECT_EQ(state_of(range, sine, none, none, {0.99, 0.0}), SleepState::stuck);
  EXPECT_EQ(state_of(range, sine, none, none, {1.01, 0.0}), SleepState::awake);
  const LinearReserve ball =
      reserve_of_ball({{3, 2, 4}, 1.0, FrictionLaw::constant(0.5)}, {1.0, 1.0, 1.0}, 3, 0.5);
  EXPECT_DOUBLE_EQ(ball.stuck, 6.0);  // (½·2 + 5) · √4 · ½
  EXPECT_DOUBLE_EQ(ball.open, 2.0);
}

}  // namespace
}  // namespace microslip::contact::test_linear_range
