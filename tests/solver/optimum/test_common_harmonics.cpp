#include "solver/optimum/common_harmonics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/continuation.hpp"
#include "solver/enrichment/curve_harmonics.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver::test_common_harmonics {
namespace {

constexpr double preload = 60.0;

Scene chain(double load) {
  Scene scene = tests::three_dof_scene(load);
  tests::use_event_cycles(scene);
  return scene;
}

ContinuationOptions choosing(double tolerance) {
  ContinuationOptions range;
  range.frequency_begin = 2.0 * std::numbers::pi * 18.0;
  range.frequency_end = 2.0 * std::numbers::pi * 30.0;
  range.n_harmonics = 30;
  range.harmonic_tolerance = tolerance;
  return range;
}

/// The highest peak with a set of harmonics.
PeakOfParameter highest_with(const HarmonicSet& set) {
  PeakOfParameter best{preload, 0.0, 0.0};
  for (const auto& point :
       trace_response(chain(preload), with_harmonics(choosing(0.01), set)).points) {
    if (point.amplitude > best.amplitude) best.amplitude = point.amplitude;
  }
  return best;
}

TEST(LackedHarmonics, AreThoseThatThePeakItselfChooses) {
  const HarmonicSet few(1);
  const PeakOfParameter best = highest_with(few);
  const double many = highest_with(HarmonicSet(9)).amplitude;
  ASSERT_GT(std::abs(best.amplitude / many - 1.0), 0.05);  // one harmonic does not tell this peak
  const ContinuationOptions range = choosing(0.01);
  PeakWork work;
  const auto lacked =
      lacked_harmonics(chain, best, nullptr, with_harmonics(range, few), range, work);
  ASSERT_TRUE(lacked);
  EXPECT_NEAR(lacked->amplitude, many, 0.01 * many);
  EXPECT_GT(lacked->range.orders.size(), 1U);
  EXPECT_EQ(lacked->range.harmonic_tolerance, 0.0);
  EXPECT_GT(work.iterations, 0);
  const PeakOfParameter settled = highest_with(HarmonicSet(lacked->range.orders));
  EXPECT_FALSE(lacked_harmonics(chain, settled, nullptr, lacked->range, range, work));
}

TEST(LackedHarmonics, AreNoneOfGivenOnes) {
  PeakWork work;
  const ContinuationOptions given = with_harmonics(choosing(0.01), HarmonicSet(3));
  EXPECT_FALSE(lacked_harmonics(chain, highest_with(HarmonicSet(3)), nullptr, given, given, work));
  EXPECT_EQ(work.iterations, 0);
}

}  // namespace
}  // namespace microslip::solver::test_common_harmonics
