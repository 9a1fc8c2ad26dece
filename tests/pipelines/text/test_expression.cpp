#include "pipelines/text/expression.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines::test_expression {
namespace {

double value(const std::string& text, double p, double r) {
  return Expression(text, "here")
      .at(Eigen::VectorXd::Constant(1, p), Eigen::VectorXd::Constant(1, r))[0];
}

std::string refusal(const std::string& text) {
  try {
    return std::to_string(value(text, 0.0, 0.0));
  } catch (const SceneError& error) {
    return error.what();
  }
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  const std::string said = refusal(text);
  for (const std::string& word : words) {
    EXPECT_NE(said.find(word), std::string::npos) << said << "\n  lacks: " << word;
  }
}

TEST(Expression, EvaluatesPositionConstantsAndFunctions) {
  EXPECT_DOUBLE_EQ(value("0.3 + 0.1*sin(40*p) - r^2", 0.02, 0.5), 0.3 + 0.1 * std::sin(0.8) - 0.25);
  EXPECT_DOUBLE_EQ(value("pi*e", 0, 0), std::numbers::pi * std::numbers::e);
  EXPECT_DOUBLE_EQ(value("log(e^2) + ln(e)", 0, 0), 3.0);
  EXPECT_DOUBLE_EQ(value("p < 0.01 ? -1e5 : 2E5", 0.02, 0), 2e5);
  EXPECT_DOUBLE_EQ(value("-p^2", 3.0, 0), -9.0);
  EXPECT_DOUBLE_EQ(value("max(p, r) * (p == 2)", 2.0, 5.0), 5.0);
  EXPECT_DOUBLE_EQ(value("atan2(p, r)", 1.0, 1.0), 0.25 * std::numbers::pi);
}

TEST(Expression, KnowsConstantsOfTheCaller) {
  const Expression expression("mu0 * (1 + p)", "here", {{"mu0", 0.4}});
  const Eigen::Vector2d p(0.0, 1.0);
  EXPECT_EQ(expression.at(p, p), Eigen::VectorXd(Eigen::Vector2d(0.4, 0.8)));
  EXPECT_THROW(Expression("1", "here", {{"2x", 1.0}}), SceneError);
}

TEST(Expression, NamesWhatItDoesNotKnow) {
  expect_words("0.3 + 0.1*x",
               {"here: ", "character 11", "\"x\" is not known", "known are p, r, e, pi", "sqrt"});
  expect_words("0.3 + sqr(p)", {"character 7", "did you mean \"sqrt\"?"});
}

TEST(Expression, TellsWhereTheSyntaxBreaks) {
  expect_words("0.3 + (p * 2", {"here: expression \"0.3 + (p * 2\"", "character"});
  expect_words("0.3 + * 2", {"character 7"});
  EXPECT_EQ(refusal("0.3 + * 2"),
            "here: expression \"0.3 + * 2\", character 7: Unexpected operator \"*\"");
  EXPECT_EQ(refusal("3 + (p"),
            "here: expression \"3 + (p\", character 7, its end: Missing parenthesis");
  EXPECT_EQ(refusal("3 ; p"), "here: expression \"3 ; p\", character 3: Unexpected token \"; p\"");
  expect_words("", {"here", "is empty"});
  expect_words(" \t", {"here", "is empty"});
  expect_words("p = 2", {"character 3", "=="});
  expect_words("p, r", {"2 values"});
  expect_words(std::string(10001, '1'), {"10001 characters"});
}

TEST(Expression, RefusesValuesThatAreNotFinite) {
  expect_words("1/p", {"inf", "p = 0 m"});
  expect_words("sqrt(r - 1)", {"nan", "r = 0 m"});
}

TEST(Expression, ReadsDecimalPointsInAnyLocale) {
  // Where the locale is not installed the default stays, and the test is the first one again.
  const char* set = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_DOUBLE_EQ(value("0.5 + p", 0.25, 0.0), 0.75);
  if (set != nullptr) {
    std::setlocale(LC_ALL, "C");
  }
}

TEST(Expression, MayBeUsedByManyThreads) {
  const Expression expression("p * 2 + r", "here");
  const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(2000, 0.0, 1.0);
  std::vector<std::thread> threads;
  std::vector<double> worst(4);
  for (std::size_t k = 0; k < worst.size(); ++k) {
    threads.emplace_back([&, k] {
      const Eigen::VectorXd r = Eigen::VectorXd::Constant(p.size(), static_cast<double>(k));
      worst[k] = (expression.at(p, r) - 2.0 * p - r).cwiseAbs().maxCoeff();
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const double error : worst) {
    EXPECT_LE(error, 1e-15);  // rounding of sums of order 5, in another order of terms
  }
}

}  // namespace
}  // namespace microslip::pipelines::test_expression
