#include "solver/enrichment/enrichment.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/solver/enrichment/cubic_bar.hpp"
#include "tests/solver/enrichment/solved_peaks.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver::test_enrichment {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// Two modes and a cubic spring; the second mode lies well above three times the first resonance.
Scene cubic_scene(double alpha) {
  Scene scene;
  scene.natural_frequency = Eigen::Vector2d(1.0, 5.0);
  scene.damping_ratio = Eigen::Vector2d(0.02, 0.02);
  scene.output = Eigen::Vector2d(1.0, 0.5);
  scene.excitation = Harmonics(1, 2);
  scene.excitation.rows().row(1) << 0.05, 0.02;
  scene.contact = std::make_unique<tests::CubicBar>(alpha, Eigen::Vector2d(1.0, 0.7));
  return scene;
}

ContinuationOptions cubic_range() {
  ContinuationOptions range;
  range.frequency_begin = 0.7;
  range.frequency_end = 1.6;
  return range;
}

struct Compared {
  Enrichment estimate;
  double amplitude = 0.0;  // solved: δA / A
  double frequency = 0.0;
};

Compared compared(const Scene& scene, const ContinuationOptions& range, const HarmonicSet& coarse,
                  const HarmonicSet& richer) {
  const auto few = tests::solved_peak(scene, range, coarse);
  const auto many = tests::solved_peak(scene, range, richer);
  const HarmonicBalance from(scene, coarse);
  const HarmonicBalance to(scene, richer);
  Compared result;
  result.estimate = enrich(to, embedded(few.peak, from, to));
  result.amplitude = many.peak.amplitude / few.peak.amplitude - 1.0;
  result.frequency = many.peak.point.parameter / few.peak.point.parameter - 1.0;
  return result;
}

TEST(Enrichment, EstimatesAreExactToFirstOrder) {
  // The third harmonic does something of the order of α: what the estimate misses is one order
  // higher.
  double before = 0.0;
  for (const double alpha : {0.04, 0.02, 0.01}) {
    const Compared one = compared(cubic_scene(alpha), cubic_range(), 1, 5);
    ASSERT_TRUE(one.estimate.has_frequency);
    EXPECT_TRUE(one.estimate.is_estimate());
    EXPECT_GT(std::abs(one.amplitude), 1e-5) << alpha;
    const double amplitude_miss = std::abs(one.estimate.amplitude / one.amplitude - 1.0);
    const double frequency_miss = std::abs(one.estimate.frequency / one.frequency - 1.0);
    std::printf("alpha %g: dA/A %.5e (estimated %.5e), dw/w %.5e (%.5e)\n", alpha, one.amplitude,
                one.estimate.amplitude, one.frequency, one.estimate.frequency);
    if (before > 0.0) {
      EXPECT_LT(amplitude_miss, 0.7 * before) << alpha;
    }
    EXPECT_LT(frequency_miss, 0.1) << alpha;
    before = amplitude_miss;
  }
  EXPECT_LT(before, 0.05);
}

TEST(Enrichment, SharesAddUpAndAreThoseOfTheirHarmonicsAlone) {
  const Scene scene = cubic_scene(0.02);
  const auto few = tests::solved_peak(scene, cubic_range(), 1);
  const HarmonicBalance from(scene, 1);
  const auto with = [&](const HarmonicSet& set) {
    const HarmonicBalance to(scene, set);
    return enrich(to, embedded(few.peak, from, to));
  };
  const Enrichment all = with(HarmonicSet(std::vector<int>{1, 3, 5}));
  double sum = 0.0;
  for (const RicherShare& share : all.shares) sum += share.amplitude;
  EXPECT_NEAR(sum, all.amplitude, 1e-14);
  const Enrichment third = with(HarmonicSet(std::vector<int>{1, 3}));
  const auto of = [](const Enrichment& one, int order) {
    for (const RicherShare& share : one.shares) {
      if (share.order == order) return share;
    }
    return RicherShare{};
  };
  // Only what the fifth does to the way the third is answered, of second order, differs.
  EXPECT_NEAR(of(all, 3).amplitude, of(third, 3).amplitude, 0.05 * std::abs(third.amplitude));
  EXPECT_GT(std::abs(of(all, 3).amplitude), 10.0 * std::abs(of(all, 5).amplitude));
  EXPECT_LT(std::abs(of(all, 0).force), 1e-10);
}

TEST(Enrichment, NothingIsLeftToEstimateInTheSameModel) {
  const Scene scene = cubic_scene(0.05);
  const Compared same = compared(scene, cubic_range(), 3, 3);
  EXPECT_LT(std::abs(same.estimate.amplitude), 1e-9);
  EXPECT_LT(std::abs(same.estimate.frequency), 1e-7);
  EXPECT_LT(same.estimate.length, 1e-7);
}

TEST(Enrichment, AtAnEndOfTheRangeTheFrequencyStays) {
  const Scene scene = cubic_scene(0.02);
  ContinuationOptions range = cubic_range();
  range.frequency_end = 1.0;  // below the resonance: the largest amplitude is at the end
  const Compared end = compared(scene, range, 1, 5);
  EXPECT_FALSE(end.estimate.has_frequency);
  EXPECT_EQ(end.estimate.frequency, 0.0);
  EXPECT_NEAR(end.estimate.amplitude, end.amplitude, 0.1 * std::abs(end.amplitude));
}

TEST(Enrichment, TellsWhatAContactPeakLacks) {
  // Five harmonics against nine under a normal load that varies: the sign and the size are right.
  ContinuationOptions range;
  range.frequency_begin = two_pi * 18.0;
  range.frequency_end = two_pi * 28.0;
  for (const double preload : {30.0, 50.0, 100.0}) {
    Scene scene = tests::three_dof_scene(preload);
    tests::use_event_cycles(scene);
    const Compared one = compared(scene, range, 5, 9);
    std::printf("%g N: dA/A %.4e (estimated %.4e), dw/w %.4e (%.4e), states %.3f, length %.3f\n",
                preload, one.amplitude, one.estimate.amplitude, one.frequency,
                one.estimate.frequency, one.estimate.states_changed, one.estimate.length);
    EXPECT_NEAR(one.estimate.amplitude, one.amplitude, 0.4 * std::abs(one.amplitude) + 1e-5)
        << preload;
  }
}

TEST(Enrichment, SaysSoWhereTheContactChangesTooMuch) {
  ContinuationOptions range;
  range.frequency_begin = two_pi * 18.0;
  range.frequency_end = two_pi * 28.0;
  Scene scene = tests::three_dof_scene(50.0);  // one harmonic is a third off
  tests::use_event_cycles(scene);
  const auto few = tests::solved_peak(scene, range, 1);
  const HarmonicBalance from(scene, 1);
  const HarmonicBalance to(scene, 9);
  const Enrichment step = enrich(to, embedded(few.peak, from, to), FrequencyStep::none);
  std::printf("states %.3f, length %.3f\n", step.states_changed, step.length);
  EXPECT_EQ(step.evaluations, 1);
  EXPECT_FALSE(step.is_estimate());
}

}  // namespace
}  // namespace microslip::solver::test_enrichment
