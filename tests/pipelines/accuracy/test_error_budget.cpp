#include <gtest/gtest.h>

#include "pipelines/accuracy/error_budget.hpp"

namespace microslip::pipelines::test_error_budget {
namespace {

CurveBudget budget(const std::string& curve, const std::string& source, double amplitude,
                   double frequency) {
  CurveBudget result;
  result.rows.push_back({curve, peak_amplitude_goal, source, amplitude, ErrorKind::solved, 1.0});
  result.rows.push_back({curve, peak_frequency_goal, source, frequency, ErrorKind::solved, 1.0});
  return result;
}

CurveBudget lacking(const std::string& curve, const std::string& source) {
  CurveBudget result = budget(curve, "cells", 1e-3, 1e-4);
  result.unknown.push_back(source);
  return result;
}

TEST(ErrorBudget, ACurveThatCannotBeFollowedHasTheLargestErrorOfTheOthers) {
  std::vector<CurveBudget> budgets{budget("a", "mesh", 0.01, -0.008), lacking("b", "mesh"),
                                   budget("c", "mesh", -0.05, -0.005), CurveBudget{}};
  EXPECT_NE(budget_text(budgets[1]).find("not known: mesh"), std::string::npos);
  borrow_unknown(budgets);
  EXPECT_TRUE(budgets[1].unknown.empty());
  EXPECT_DOUBLE_EQ(bar_of(budgets[1].rows, "b", peak_amplitude_goal), 0.051);
  EXPECT_DOUBLE_EQ(bar_of(budgets[1].rows, "b", peak_frequency_goal), 0.0081);
  EXPECT_EQ(budgets[1].rows.back().kind, ErrorKind::borrowed);
  EXPECT_NE(budget_text(budgets[1]).find("mesh -5 % (as of another curve)"), std::string::npos);
  EXPECT_EQ(budgets[0].rows.size(), 2U);
  EXPECT_TRUE(budgets[3].rows.empty());
}

TEST(ErrorBudget, WhatNoCurveKnowsStaysUnknown) {
  std::vector<CurveBudget> budgets{lacking("a", "mesh"), lacking("b", "mesh"),
                                   lacking("c", "harmonics"), budget("d", "harmonics", 0.1, 0.0)};
  borrow_unknown(budgets);
  EXPECT_EQ(budgets[0].unknown, std::vector<std::string>{"mesh"});
  // Other harmonics are another curve, not an error to be bounded by that of another.
  EXPECT_FALSE(budgets[2].has_bar());
}

}  // namespace
}  // namespace microslip::pipelines::test_error_budget
