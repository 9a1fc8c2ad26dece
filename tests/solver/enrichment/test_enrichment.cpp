#include "solver/enrichment/enrichment.hpp"

#include <algorithm>
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
  double estimate = 0.0;   // δA / A
  double amplitude = 0.0;  // solved
};

double sum(const std::vector<RicherShare>& shares) {
  double result = 0.0;
  for (const RicherShare& share : shares) result += share.amplitude;
  return result;
}

Compared compared(const Scene& scene, const ContinuationOptions& range, const HarmonicSet& coarse,
                  const HarmonicSet& richer) {
  const auto few = tests::solved_peak(scene, range, coarse);
  const auto many = tests::solved_peak(scene, range, richer);
  HarmonicBalance from(scene, coarse);
  HarmonicBalance to(scene, richer);
  Compared result;
  result.estimate = sum(richer_shares(to, embedded(few.peak, from, to)));
  result.amplitude = many.peak.amplitude / few.peak.amplitude - 1.0;
  return result;
}

TEST(Enrichment, EstimatesAreExactToFirstOrder) {
  // The third harmonic does something of the order of α: what the estimate misses is one order
  // higher.
  double before = 0.0;
  for (const double alpha : {0.04, 0.02, 0.01}) {
    const Compared one = compared(cubic_scene(alpha), cubic_range(), 1, 5);
    EXPECT_GT(std::abs(one.amplitude), 1e-5) << alpha;
    const double amplitude_miss = std::abs(one.estimate / one.amplitude - 1.0);
    std::printf("alpha %g: dA/A %.5e (estimated %.5e)\n", alpha, one.amplitude, one.estimate);
    if (before > 0.0) {
      EXPECT_LT(amplitude_miss, 0.7 * before) << alpha;
    }
    before = amplitude_miss;
  }
  EXPECT_LT(before, 0.05);
}

TEST(Enrichment, SharesAreThoseOfTheirHarmonicsAlone) {
  const Scene scene = cubic_scene(0.02);
  const auto few = tests::solved_peak(scene, cubic_range(), 1);
  HarmonicBalance from(scene, 1);
  const auto with = [&](const HarmonicSet& set) {
    HarmonicBalance to(scene, set);
    return richer_shares(to, embedded(few.peak, from, to));
  };
  const std::vector<RicherShare> all = with(HarmonicSet(std::vector<int>{1, 3, 5}));
  const std::vector<RicherShare> third = with(HarmonicSet(std::vector<int>{1, 3}));
  const auto of = [](const std::vector<RicherShare>& shares, int order) {
    return std::ranges::find(shares, order, &RicherShare::order)->amplitude;
  };
  // Only what the fifth does to the way the third is answered, of second order, differs.
  EXPECT_NEAR(of(all, 3), of(third, 3), 0.05 * std::abs(sum(third)));
  EXPECT_GT(std::abs(of(all, 3)), 10.0 * std::abs(of(all, 5)));
  EXPECT_LT(std::abs(of(all, 0)), 1e-10);
}

TEST(Enrichment, NothingIsLeftToEstimateInTheSameModel) {
  const Scene scene = cubic_scene(0.05);
  const Compared same = compared(scene, cubic_range(), 3, 3);
  EXPECT_LT(std::abs(same.estimate), 1e-9);
}

TEST(Enrichment, HoldsAtAnEndOfTheRange) {
  const Scene scene = cubic_scene(0.02);
  ContinuationOptions range = cubic_range();
  range.frequency_end = 1.0;  // below the resonance: the largest amplitude is at the end
  const Compared end = compared(scene, range, 1, 5);
  EXPECT_NEAR(end.estimate, end.amplitude, 0.1 * std::abs(end.amplitude));
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
    std::printf("%g N: dA/A %.4e (estimated %.4e)\n", preload, one.amplitude, one.estimate);
    EXPECT_NEAR(one.estimate, one.amplitude, 0.4 * std::abs(one.amplitude) + 1e-5) << preload;
  }
}

}  // namespace
}  // namespace microslip::solver::test_enrichment
