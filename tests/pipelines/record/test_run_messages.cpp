// What a curve is warned of.
#include "pipelines/record/run_messages.hpp"

#include <string>

#include <gtest/gtest.h>

namespace microslip::pipelines::test_run_messages {
namespace {

/// Of as many folds, every second point unstable.
CurveResult folded(int n_folds) {
  CurveResult result;
  result.name = "folded";
  for (int i = 0; i < 2 * n_folds; ++i) {
    solver::ResponsePoint& point = result.curve.points.emplace_back();
    point.mark = i % 2 == 0 ? solver::PointMark::fold : solver::PointMark::peak;
    point.stability = i % 2 == 0 ? solver::Stability::unstable : solver::Stability::stable;
  }
  return result;
}

/// A curve with one peak, and a point at the end of its range.
CurveResult with_end(double peak, double end) {
  CurveResult result;
  result.name = "ended";
  result.curve.complete = true;
  for (const double amplitude : {0.5 * peak, peak, end}) {
    solver::ResponsePoint& point = result.curve.points.emplace_back();
    point.amplitude = amplitude;
    point.frequency = 100.0 * static_cast<double>(result.curve.points.size());
  }
  result.curve.points[1].mark = solver::PointMark::peak;
  return result;
}

CurveBudget bar_of_amplitude(double bar) {
  CurveBudget budget;
  budget.rows.push_back({"two", peak_amplitude_goal, "harmonics", bar});
  return budget;
}

TEST(RunMessages, APeakThatIsAsHighToWhatIsKnownIsNamed) {
  CurveResult result = with_end(2.0, 0.1);
  result.name = "two";
  solver::ResponsePoint second = result.curve.points[1];
  second.frequency *= 1.1;
  second.amplitude = 1.99;
  result.curve.points.push_back(second);
  const std::string text = rival_text(result, bar_of_amplitude(2e-3));
  EXPECT_NE(text.find("curve two: a second peak, 1.99 m at"), std::string::npos) << text;
  EXPECT_EQ(rival_text(result, bar_of_amplitude(1e-3)), "");
  EXPECT_EQ(rival_text(result, {}), "");
}

TEST(RunMessages, ABestValueWhereTwoPeaksCrossSaysSo) {
  solver::Optimum optimum;
  optimum.best = {.parameter = 1.0, .frequency = 100.0, .amplitude = 2.0};
  optimum.trace = {{.parameter = 0.99, .frequency = 100.1, .amplitude = 2.001}, optimum.best};
  EXPECT_EQ(crossing_text(optimum), "");
  optimum.trace.push_back({.parameter = 1.01, .frequency = 95.0, .amplitude = 2.001});
  EXPECT_NE(crossing_text(optimum).find("two peaks are equally high there"), std::string::npos);
  optimum.trace.back().parameter = 1.1;
  EXPECT_EQ(crossing_text(optimum), "");
}

TEST(RunMessages, ACurveNamesWhatIsLargestBesideItsPeak) {
  const std::string lower = outcome_text(with_end(2.0, 1.0));
  EXPECT_NE(lower.find("; largest 2 m at"), std::string::npos) << lower;
  const std::string higher = outcome_text(with_end(2.0, 3.0));
  EXPECT_NE(higher.find("; highest peak 2 m at"), std::string::npos) << higher;
  EXPECT_NE(higher.find(", largest 3 m at"), std::string::npos) << higher;
}

TEST(RunMessages, ABranchAboveTheCurveIsToldUnlessItIsUnstable) {
  CurveResult result = with_end(2.0, 1.0);
  EXPECT_FALSE(has_higher_branch(result));
  solver::ResponsePoint beside = result.curve.points[1];
  result.curve.detached.push_back({.points = {beside}});
  EXPECT_FALSE(has_higher_branch(result));
  EXPECT_EQ(detached_text(result).at(0).find("above the curve"), std::string::npos);
  result.curve.detached[0].points[0].amplitude = 2.1;
  EXPECT_TRUE(has_higher_branch(result));
  EXPECT_NE(detached_text(result).at(0).find("above the curve"), std::string::npos);
  result.curve.detached[0].points[0].stability = solver::Stability::unstable;
  EXPECT_FALSE(has_higher_branch(result));
}

TEST(RunMessages, ManyFoldsAreToldWithARemedy) {
  EXPECT_TRUE(many_folds_text(folded(4)).empty());
  const std::string text = many_folds_text(folded(52));
  EXPECT_NE(text.find("curve folded: 52 folds, 50 % of its points unstable"), std::string::npos)
      << text;
  EXPECT_NE(text.find("response.method"), std::string::npos) << text;
}

TEST(RunMessages, ABracketOfFewHarmonicsSaysSo) {
  OptimumBracket bracket;
  bracket.entries.resize(2);
  EXPECT_EQ(few_harmonics_text(bracket), "");
  for (OptimumOfFactor& entry : bracket.entries) entry.n_harmonics = 3;
  bracket.entries.front().parameter = "friction_coefficient";
  const std::string text = few_harmonics_text(bracket);
  EXPECT_NE(text.find("with 3 harmonics"), std::string::npos) << text;
  EXPECT_NE(text.find("compare with friction_coefficient x 1,"), std::string::npos) << text;
  bracket.entries.front().factor = 0.5;  // friction is not varied
  EXPECT_NE(few_harmonics_text(bracket).find("with one another"), std::string::npos);
}

}  // namespace
}  // namespace microslip::pipelines::test_run_messages
