#include "solver/optimum/peak_trace.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "tests/solver/humped_damping.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/readable_patch.hpp"
#include "tests/support/traced_peaks.hpp"

namespace microslip::solver::test_peak_trace {
namespace {

using tests::frequency_range;

ContinuationOptions chain_range() {
  return frequency_range(2.0 * std::numbers::pi * 18.0, 2.0 * std::numbers::pi * 28.0);
}

PeakTraceOptions between(double lower, double upper, int n_values) {
  PeakTraceOptions options;
  options.lower = lower;
  options.upper = upper;
  options.n_values = n_values;
  return options;
}

/// A random scene with all preloads and gaps times a factor.
Scene with_preload(std::uint64_t seed, double factor) {
  tests::RandomScene random = tests::random_scene(seed);
  const auto& patch = dynamic_cast<const tests::ReadablePatch&>(*random.scene.contact);
  std::vector<contact::PointParameters> points = patch.patch().points();
  for (contact::PointParameters& point : points) point.rest_load *= factor;
  random.scene.contact = std::make_unique<tests::ReadablePatch>(
      contact::ContactPatch(patch.patch().weights(), std::move(points)), patch.shapes());
  return std::move(random.scene);
}

TEST(PeakTrace, OfTheChainIsThatOfWholeCurves) {
  const PeakTrace trace =
      tests::traced_peaks(tests::chain_scene, chain_range(), between(3.0, 600.0, 30));
  ASSERT_EQ(trace.peaks.size(), 30U);
  EXPECT_LT(trace.n_curves, 8);
  for (const PeakOfParameter& peak : trace.peaks) {
    // Two solutions of one peak differ by rounding.
    EXPECT_NEAR(peak.amplitude,
                tests::highest_of_curve(tests::chain_scene(peak.parameter), chain_range()),
                1e-10 * peak.amplitude)
        << peak.parameter;
  }
}

TEST(PeakTrace, FollowsPeaksThatLieBesideFolds) {
  const auto family = [](double preload) { return tests::three_dof_scene(preload); };
  const PeakTrace trace = tests::traced_peaks(family, chain_range(), between(10.0, 600.0, 25));
  ASSERT_EQ(trace.peaks.size(), 25U);
  EXPECT_LT(trace.n_curves, 13);
  for (const PeakOfParameter& peak : trace.peaks) {
    EXPECT_NEAR(peak.amplitude, tests::highest_of_curve(family(peak.parameter), chain_range()),
                1e-10 * peak.amplitude)
        << peak.parameter;
  }
}

/// Two modes without coupling; the parameter is the force on the second, so that its peak F/(2ζω²)
/// overtakes that of the first at F = 4.
Scene two_modes(double force) {
  Scene scene;
  scene.natural_frequency = Eigen::Vector2d(1.0, 2.0);
  scene.damping_ratio = Eigen::Vector2d(0.01, 0.01);
  scene.output = Eigen::Vector2d(1.0, 1.0);
  scene.excitation = contact::Harmonics(1, 2);
  scene.excitation.rows().row(1) << 1.0, force;
  return scene;
}

TEST(PeakTrace, SeesASecondPeakOvertake) {
  const PeakTrace trace =
      tests::traced_peaks(two_modes, frequency_range(0.5, 3.0), between(1.0, 16.0, 20));
  ASSERT_EQ(trace.peaks.size(), 20U);
  for (const PeakOfParameter& peak : trace.peaks) {
    EXPECT_NEAR(peak.frequency, peak.parameter < 4.0 ? 1.0 : 2.0, 0.02) << peak.parameter;
  }
}

TEST(PeakTrace, BegunWithOneCurveIsThatOfThree) {
  PeakTraceOptions options = between(30.0, 300.0, 9);
  options.n_checks = 3;
  const PeakTrace of_three = tests::traced_peaks(tests::chain_scene, chain_range(), options);
  options.only_check = 90.0;
  const PeakTrace of_one = tests::traced_peaks(tests::chain_scene, chain_range(), options);
  EXPECT_LT(of_one.n_curves, of_three.n_curves);
  ASSERT_EQ(of_one.peaks.size(), of_three.peaks.size());
  for (std::size_t i = 0; i < of_one.peaks.size(); ++i) {
    const double amplitude = of_three.peaks[i].amplitude;
    EXPECT_NEAR(of_one.peaks[i].amplitude, amplitude, 1e-8 * amplitude)
        << of_one.peaks[i].parameter;
  }
}

TEST(PeakTrace, FollowsNoPeakTwiceToOneValue) {
  PeakTraceOptions coarse = between(0.1, 10.0, 9);
  coarse.amplitude_tolerance = 3e-3;
  for (const std::uint64_t seed : {11U, 23U}) {  // where a curve refutes peaks, or families meet
    const SceneFamily family = [seed](double factor) { return with_preload(seed, factor); };
    PeakFamilies families(family, tests::random_scene(seed).options, coarse);
    families.trace();
    for (const double factor : {0.4, 3.0}) {
      static_cast<void>(families.confirm(factor));
      const double amplitude = families.highest(factor).amplitude;
      const long evaluations = families.result().contact_evaluations;
      EXPECT_EQ(families.highest(factor).amplitude, amplitude) << seed << " factor " << factor;
      EXPECT_EQ(families.result().contact_evaluations, evaluations) << seed << " factor " << factor;
    }
  }
}

TEST(PeakTrace, TakesAnyParameterOnALinearScale) {
  // The normal load of a gap oscillator from bonded to open: the parameter changes its sign.
  const auto family = [](double load) {
    tests::SinglePoint single;
    single.point = {0.0, 2.0, 0.0, load};
    single.phi_v = 1.0;
    single.force = 0.2;
    return tests::single_point_scene(single);
  };
  PeakTraceOptions options = between(-4.0, 4.0, 17);
  options.scale = ParameterScale::linear;
  const PeakTrace trace = tests::traced_peaks(family, frequency_range(0.5, 2.5), options);
  ASSERT_EQ(trace.peaks.size(), 17U);
  for (const PeakOfParameter& peak : trace.peaks) {
    EXPECT_NEAR(peak.amplitude,
                tests::highest_of_curve(family(peak.parameter), frequency_range(0.5, 2.5)),
                1e-10 * peak.amplitude)
        << peak.parameter;
  }
}

TEST(PeakTrace, CountsDetachedBranchesWhereASearchFindsThem) {
  PeakTraceOptions options = between(0.45, 0.55, 5);
  options.n_checks = 2;
  ContinuationOptions searched = frequency_range(0.6, 1.4);
  searched.search_starts = 12;
  const PeakTrace with = tests::traced_peaks(tests::isola_scene, searched, options);
  ASSERT_EQ(with.peaks.size(), 5U);
  for (const PeakOfParameter& peak : with.peaks) {
    EXPECT_NEAR(peak.amplitude, 10.0 * peak.parameter, 1e-6);  // of the isola, at its root
    EXPECT_EQ(peak.detached, peak.whole_curve);                // told where the curve is known
  }
  EXPECT_TRUE(with.peaks.front().detached);
  EXPECT_GE(with.warnings.size(), 2U);  // one for each check
  for (const PeakOfParameter& peak :
       tests::traced_peaks(tests::isola_scene, frequency_range(0.6, 1.4), options).peaks) {
    EXPECT_LT(peak.amplitude, 2.0);
    EXPECT_FALSE(peak.detached);
  }
}

TEST(PeakTrace, RefusesBoundsThatAreNone) {
  EXPECT_THROW(static_cast<void>(
                   tests::traced_peaks(two_modes, frequency_range(0.5, 3.0), between(2.0, 1.0, 5))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(tests::traced_peaks(two_modes, frequency_range(0.5, 3.0),
                                                     between(-1.0, 1.0, 5))),
               std::invalid_argument);
}

TEST(PeakTrace, OfRandomScenesIsThatOfWholeCurves) {
  int values = 0;
  PeakTraceOptions coarse = between(0.1, 10.0, 9);
  coarse.amplitude_tolerance = 3e-3;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ContinuationOptions options = tests::random_scene(seed).options;
    const auto family = [&](double factor) { return with_preload(seed, factor); };
    const auto expect_of_curves = [&](const PeakTraceOptions& sought, double tolerance) {
      const PeakTrace trace = tests::traced_peaks(family, options, sought);
      values += static_cast<int>(trace.peaks.size());
      for (const PeakOfParameter& peak : trace.peaks) {
        const double whole = tests::highest_of_curve(family(peak.parameter), options);
        EXPECT_NEAR(peak.amplitude, whole, tolerance * whole)
            << seed << " factor " << peak.parameter;
      }
    };
    expect_of_curves(between(0.1, 10.0, 9), 1e-8);
    expect_of_curves(coarse, coarse.amplitude_tolerance);
  }
  EXPECT_GT(values, 40);
}

TEST(PeakTrace, OfPeaksThatEnterAndLeaveTheRangeIsThatOfWholeCurves) {
  int at_an_end = 0;
  int at_a_peak = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    ContinuationOptions options = tests::random_scene(seed).options;
    const double width = options.frequency_end - options.frequency_begin;
    options.frequency_begin += 0.35 * width;
    options.frequency_end -= 0.35 * width;
    const auto family = [&](double factor) { return with_preload(seed, factor); };
    const PeakTrace trace = tests::traced_peaks(family, options, between(0.1, 10.0, 9));
    EXPECT_EQ(trace.peaks.size(), 9U) << seed;
    for (const PeakOfParameter& peak : trace.peaks) {
      (peak.place == PeakPlace::range_end ? at_an_end : at_a_peak) += 1;
      const double whole = tests::highest_of_curve(family(peak.parameter), options);
      EXPECT_NEAR(peak.amplitude, whole, 1e-8 * whole) << seed << " factor " << peak.parameter;
    }
  }
  EXPECT_GT(at_an_end, 5);
  EXPECT_GT(at_a_peak, 5);
}

}  // namespace
}  // namespace microslip::solver::test_peak_trace
