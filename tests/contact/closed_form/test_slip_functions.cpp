#include "contact/closed_form/slip_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace microslip::contact::test_slip_functions {
namespace {

// At θ_P, θ_N and δ the functions have the extrema they are named for.
TEST(SlipFunctions, DirectionsPointAtTheExtrema) {
  const PointParameters point{2.0, 3.0, 0.4, 1.5};
  const PointMotion m{.u_sin = 0.3, .u_cos = -1.1, .v_mean = 0.2, .v_sin = 0.7, .v_cos = 0.4};
  const SlipFunctions w = slip_functions(point, m);
  const auto u = [&](const Direction& d) { return 2.0 * (m.u_sin * d.sin + m.u_cos * d.cos); };
  const auto v = [&](const Direction& d) { return 3.0 * (m.v_sin * d.sin + m.v_cos * d.cos); };
  // A handful of roundings of numbers of order one.
  EXPECT_NEAR(u(w.end_of_positive) - 0.4 * v(w.end_of_positive), w.positive, 1e-15);
  EXPECT_NEAR(u(w.end_of_negative) + 0.4 * v(w.end_of_negative), -w.negative, 1e-15);
  EXPECT_NEAR(v(w.largest_load), w.load_amplitude, 1e-15);
  EXPECT_NEAR(w.bias_load, 2.1, 1e-15);
  EXPECT_NEAR(w.difference, w.negative - w.positive, 1e-15);
  EXPECT_NEAR(w.excess, w.positive + w.negative - 2.0 * 0.4 * 2.1, 1e-15);
}

// Pythagorean numbers: B = 5 exactly, n₀ = 5 − 2⁻⁵⁰, and the difference keeps all its digits; the
// same for the onset of slip with constant load, 2 (5 − q).
TEST(SlipFunctions, DifferencesKeepTheirDigitsNearALimit) {
  const double off = std::exp2(-50);
  const SlipFunctions load =
      slip_functions({1.0, 1.0, 0.5, 5.0 - off}, {.u_sin = 1.0, .v_sin = 3.0, .v_cos = 4.0});
  EXPECT_EQ(load.below_closed, off);
  const SlipFunctions slip =
      slip_functions({1.0, 0.0, 0.5, 10.0 - 2.0 * off}, {.u_sin = 3.0, .u_cos = 4.0});
  EXPECT_EQ(slip.excess, 2.0 * off);
}

// A length that is no double: B = √2, n₀ the double next to it; B − n₀ is known to 30 digits.
TEST(SlipFunctions, RootsAreRefinedBeyondDoublePrecision) {
  const double n0 = std::sqrt(2.0);
  const SlipFunctions w =
      slip_functions({1.0, 1.0, 0.5, n0}, {.u_sin = 0.1, .v_sin = 1.0, .v_cos = 1.0});
  // √2 − fl(√2) = −9.667293313452913e-17 (√2 = 1.41421356237309504880168872…).
  EXPECT_NEAR(w.below_closed, -9.667293313452913e-17, 1e-30);
}

TEST(SlipFunctions, NothingUnderflowsThatMatters) {
  const SlipFunctions w = slip_functions(
      {1.0, 1.0, 0.5, 0.0}, {.u_sin = 3e-100, .u_cos = 4e-100, .v_sin = 3e-100, .v_cos = 4e-100});
  EXPECT_NEAR(w.load_amplitude / 5e-100, 1.0, 1e-15);
  EXPECT_NEAR(w.positive / 2.5e-100, 1.0, 1e-15);
  EXPECT_NEAR(w.difference / 5e-100, 1.0, 1e-15);
}

TEST(SlipFunctions, PreloadThatTheMeanApproachCancelsKeepsItsDigits) {
  const double k = 1e6 + 0.1;
  const double v = -1.0 + 1e-7;
  const SlipFunctions w = slip_functions({1.0, k, 0.5, 1e6}, {.u_sin = 1.0, .v_mean = v});
  EXPECT_EQ(w.bias_load, std::fma(k, v, 1e6));
}

}  // namespace
}  // namespace microslip::contact::test_slip_functions
