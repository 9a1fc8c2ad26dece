#include "solver/peak.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

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
  EXPECT_TRUE(std::is_sorted(optimum.trace.begin(), optimum.trace.end(),
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

}  // namespace
}  // namespace microslip::solver
