#include "pipelines/expression.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace microslip::pipelines {
namespace {

double value(const std::string& text, double x = 0.0, double L = 1.0) {
  return Expression(text, {"x", "L"})(std::array{x, L});
}

std::string complaint(const std::string& text) {
  try {
    static_cast<void>(value(text));
    return {};
  } catch (const ExpressionError& error) {
    return error.what();
  }
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
  EXPECT_DOUBLE_EQ(value("1 + 2*3 - 4/8"), 6.5);
  EXPECT_DOUBLE_EQ(value("(1+2)*3"), 9.0);
  EXPECT_DOUBLE_EQ(value("8-3-2"), 3.0);
  EXPECT_DOUBLE_EQ(value("8/4/2"), 1.0);
  EXPECT_DOUBLE_EQ(value("2^3^2"), 512.0);
  EXPECT_DOUBLE_EQ(value("-3^2"), -9.0);
  EXPECT_DOUBLE_EQ(value("2^-2"), 0.25);
  EXPECT_DOUBLE_EQ(value("2*-3"), -6.0);
  EXPECT_DOUBLE_EQ(value("1.5e-3*.5e3"), 0.75);
}

TEST(Expression, KnowsItsVariablesAndFunctions) {
  EXPECT_DOUBLE_EQ(value("2000*(0.2 + 0.8*(2*x/L - 1)^2)", 0.25, 1.0), 2000.0 * 0.4);
  EXPECT_DOUBLE_EQ(value("sin(pi/6) + cos(0) + sqrt(x) + abs(-L)", 4.0, 3.0), 0.5 + 1.0 + 2.0 + 3.0);
  EXPECT_DOUBLE_EQ(value("exp(log(x))*tan(pi/4)", 7.0), 7.0);
  EXPECT_TRUE(std::isinf(value("1/x")));
  EXPECT_TRUE(std::isnan(value("sqrt(-1)")));
}

TEST(Expression, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(complaint("2*(x+1").find("expected \")\""), std::string::npos);
  EXPECT_NE(complaint("2*y").find("character 3: \"y\" is not known here; known: x, L, pi"),
            std::string::npos);
  EXPECT_NE(complaint("").find("ends too early"), std::string::npos);
  EXPECT_NE(complaint("1 2").find("character 3"), std::string::npos);
  EXPECT_NE(complaint("sin x").find("expected \"(\" after sin"), std::string::npos);
  EXPECT_NE(complaint("sinh(x)").find("\"sinh\" is not known"), std::string::npos);
  EXPECT_NE(complaint("2**3").find("\"*\" is out of place"), std::string::npos);
}

TEST(Expression, RefusesNestingThatWouldEatTheStack) {
  EXPECT_FALSE(complaint(std::string(100'000, '(')).empty());
  EXPECT_FALSE(complaint(std::string(100'000, '-') + "1").empty());
  EXPECT_TRUE(complaint(std::string(50, '(') + "1" + std::string(50, ')')).empty());
}

}  // namespace
}  // namespace microslip::pipelines
