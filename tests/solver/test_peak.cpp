#include "solver/peak.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/modal_scenes.hpp"

namespace microslip::solver {
namespace {

ContinuationOptions chain_range() {
  ContinuationOptions options;
  options.frequency_begin = 2.0 * M_PI * 18.0;
  options.frequency_end = 2.0 * M_PI * 28.0;
  return options;
}

double highest_peak(const Scene& scene) {
  double highest = 0.0;
  for (const ResponsePoint& point : trace_response(scene, chain_range()).points) {
    if (point.mark == PointMark::peak) highest = std::max(highest, point.amplitude);
  }
  return highest;
}

TEST(MinimisePeak, FindsThePreloadBetterThanItsNeighbours) {
  OptimumOptions options;
  options.lower = 3.0;
  options.upper = 600.0;
  const Optimum optimum = minimise_peak(tests::chain_scene, chain_range(), options);
  ASSERT_TRUE(optimum.found) << optimum.message;
  // Of 10, 20, 30, 50, 100, 200 N paper B finds 30 N best (theory section 20.3).
  EXPECT_GT(optimum.best.parameter, 20.0);
  EXPECT_LT(optimum.best.parameter, 50.0);
  EXPECT_NEAR(highest_peak(tests::chain_scene(optimum.best.parameter)), optimum.best.amplitude,
              1e-12 * optimum.best.amplitude);
  for (const double factor : {0.97, 1.03}) {
    EXPECT_GT(highest_peak(tests::chain_scene(factor * optimum.best.parameter)),
              optimum.best.amplitude);
  }
  EXPECT_NE(optimum.message.find("as good to 1 %"), std::string::npos) << optimum.message;
  for (std::size_t i = 1; i < optimum.trace.size(); ++i) {
    EXPECT_LT(optimum.trace[i - 1].parameter, optimum.trace[i].parameter);
    EXPECT_GE(optimum.trace[i].amplitude, optimum.best.amplitude);
  }
}

TEST(MinimisePeak, SaysWhenTheMinimumLiesAtTheBound) {
  OptimumOptions options;
  options.lower = 60.0;
  options.upper = 300.0;
  const Optimum optimum = minimise_peak(tests::chain_scene, chain_range(), options);
  EXPECT_FALSE(optimum.found);
  EXPECT_NE(optimum.message.find("bound"), std::string::npos);
  EXPECT_EQ(optimum.best.parameter, optimum.trace.front().parameter);
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

TEST(MinimisePeak, RefusesBoundsThatAreNone) {
  OptimumOptions options;
  options.lower = 2.0;
  options.upper = 1.0;
  EXPECT_THROW(static_cast<void>(minimise_peak(tests::chain_scene, chain_range(), options)),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::solver
