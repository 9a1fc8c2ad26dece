#include "solver/peak.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"

namespace microslip::solver {
namespace {

ContinuationOptions range() {
  ContinuationOptions options;
  options.frequency_begin = 0.7;
  options.frequency_end = 2.2;
  return options;
}

Scene rubbing(double preload) {
  tests::SinglePoint single;
  single.point = {2.0, 0.0, 0.5, preload};
  return tests::single_point_scene(single);
}

double highest_peak(double preload) {
  double highest = 0.0;
  for (const auto& point : trace_response(rubbing(preload), range()).points) {
    if (point.mark == PointMark::peak) highest = std::max(highest, point.amplitude);
  }
  return highest;
}

TEST(MinimisePeak, FindsAPreloadThatNoNeighbourBeats) {
  OptimumOptions options;
  options.lower = 0.1;
  options.upper = 100.0;
  const Optimum optimum = minimise_peak(rubbing, range(), options);
  ASSERT_TRUE(optimum.found) << optimum.message;
  EXPECT_NEAR(optimum.best.amplitude, highest_peak(optimum.best.parameter), 1e-10);
  for (const double factor : {0.9, 0.99, 1.01, 1.1}) {
    EXPECT_LT(optimum.best.amplitude, highest_peak(factor * optimum.best.parameter));
  }
  EXPECT_TRUE(
      std::is_sorted(optimum.trace.begin(), optimum.trace.end(),
                     [](const auto& a, const auto& b) { return a.parameter < b.parameter; }));
}

TEST(MinimisePeak, SaysWhenTheSmallestPeakLiesAtABound) {
  OptimumOptions options;
  options.lower = 0.001;
  options.upper = 0.1;  // below the optimum: the peak falls all the way
  const Optimum optimum = minimise_peak(rubbing, range(), options);
  EXPECT_FALSE(optimum.found);
  EXPECT_NE(optimum.message.find("bound"), std::string::npos);
}

TEST(MinimisePeak, RefusesBoundsThatAreNone) {
  OptimumOptions options;
  options.lower = 2.0;
  options.upper = 1.0;
  EXPECT_THROW(static_cast<void>(minimise_peak(rubbing, range(), options)), std::invalid_argument);
}

ContinuationOptions chain_range() {
  ContinuationOptions options;
  options.frequency_begin = 2.0 * std::numbers::pi * 18.0;
  options.frequency_end = 2.0 * std::numbers::pi * 28.0;
  return options;
}

double highest_of_chain(double preload) {
  double highest = 0.0;
  for (const auto& point : trace_response(tests::chain_scene(preload), chain_range()).points) {
    if (point.mark == PointMark::peak) highest = std::max(highest, point.amplitude);
  }
  return highest;
}

TEST(MinimisePeak, FindsTheBestPreloadOfPaperBNearThirtyNewtons) {
  OptimumOptions options;
  options.lower = 3.0;
  options.upper = 600.0;
  const Optimum optimum = minimise_peak(tests::chain_scene, chain_range(), options);
  ASSERT_TRUE(optimum.found) << optimum.message;
  // Of 10, 20, 30, 50, 100, 200 N paper B finds 30 N best (theory section 20.3).
  EXPECT_GT(optimum.best.parameter, 20.0);
  EXPECT_LT(optimum.best.parameter, 50.0);
  EXPECT_NEAR(highest_of_chain(optimum.best.parameter), optimum.best.amplitude,
              1e-12 * optimum.best.amplitude);
  double low = 0.0;
  double high = 0.0;
  ASSERT_EQ(std::sscanf(optimum.message.c_str(), "as good to 1 %% from %lf to %lf", &low, &high), 2)
      << optimum.message;
  for (const double end : {low, high}) {
    // The ends are known to a share of the valley; six digits are printed.
    EXPECT_LT(highest_of_chain(end), 1.01001 * optimum.best.amplitude) << end;
    EXPECT_GT(highest_of_chain(end), 1.009 * optimum.best.amplitude) << end;
  }
  for (std::size_t i = 1; i < optimum.trace.size(); ++i) {
    EXPECT_LT(optimum.trace[i - 1].parameter, optimum.trace[i].parameter);
    EXPECT_GE(optimum.trace[i].amplitude, optimum.best.amplitude);
  }
}

TEST(MinimisePeak, SaysWhenThereIsNoPeak) {
  ContinuationOptions below = chain_range();
  below.frequency_begin = 10.0;
  below.frequency_end = 20.0;
  OptimumOptions options;
  options.lower = 10.0;
  options.upper = 100.0;
  const Optimum optimum = minimise_peak(tests::chain_scene, below, options);
  EXPECT_FALSE(optimum.found);
  EXPECT_FALSE(optimum.message.empty());
}

}  // namespace
}  // namespace microslip::solver
