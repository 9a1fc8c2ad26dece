/// Sign changes of smooth functions against those they were made with.
#include "contact/numerics/smooth_signs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace microslip::contact::test_smooth_signs {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> of(const std::vector<SmoothSign>& found, int function) {
  std::vector<double> phases;
  for (const SmoothSign& sign : found) {
    if (sign.function == function) phases.push_back(sign.phase);
  }
  std::sort(phases.begin(), phases.end());
  return phases;
}

TEST(SmoothSigns, AreThoseOfBothFunctions) {
  std::vector<SmoothSign> found;
  const auto f = [](double x) -> std::array<double, 2> { return {std::sin(3.0 * x), std::cos(x)}; };
  add_smooth_signs(f, 0.5, 2.0 * pi, 0.7, 1.0, found);
  const std::vector<double> first = of(found, 0);
  ASSERT_EQ(first.size(), 5U);
  // Functions to 1e-10 of their size, slopes of 3 and 1.
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(first[static_cast<std::size_t>(k)], (k + 1) * pi / 3.0, 1e-10);
  const std::vector<double> second = of(found, 1);
  ASSERT_EQ(second.size(), 2U);
  EXPECT_NEAR(second[0], 0.5 * pi, 1e-10);
  EXPECT_NEAR(second[1], 1.5 * pi, 1e-10);
}

// A pair is there as long as the function rises to the tolerance between them: (x − 1)² − w².
TEST(SmoothSigns, APairIsFoundHoweverClose) {
  for (const double width : {0.1, 1e-2, 1e-3, 1e-4}) {
    std::vector<SmoothSign> found;
    const auto f = [width](double x) -> std::array<double, 2> {
      return {std::pow(std::sin(x - 1.0), 2) - width * width, 1.0};
    };
    add_smooth_signs(f, 0.0, 3.0, 1.0, 1.0, found);
    const std::vector<double> pair = of(found, 0);
    ASSERT_EQ(pair.size(), 2U) << width;
    EXPECT_NEAR(pair[0], 1.0 - std::asin(width), 1e-10 / width);
    EXPECT_NEAR(pair[1], 1.0 + std::asin(width), 1e-10 / width);
  }
}

TEST(SmoothSigns, ATouchIsNone) {
  std::vector<SmoothSign> found;
  const auto f = [](double x) -> std::array<double, 2> {
    return {0.0, 1e-6 + std::pow(x - 1.0, 2)};
  };
  add_smooth_signs(f, 0.0, 3.0, 1.0, 1.0, found);
  EXPECT_TRUE(found.empty());
}

// What changes within a cell is resolved by halving it, as long as a point of the cell sees it.
TEST(SmoothSigns, AreFoundInALayer) {
  for (const double width : {0.3, 1e-1, 2e-2, 1e-2}) {
    std::vector<SmoothSign> found;
    const auto f = [width](double x) -> std::array<double, 2> {
      return {1.0 - 2.0 * std::exp((x - 1.0) / width), 1.0};
    };
    add_smooth_signs(f, 0.0, 1.0, 1.0, 1.0, found);
    const std::vector<double> change = of(found, 0);
    ASSERT_EQ(change.size(), 1U) << width;
    EXPECT_NEAR(change[0], 1.0 - width * std::numbers::ln2, 1e-10) << width;
  }
}

// An interval may be as short as it likes: it is told by offsets, and rates are large on it.
TEST(SmoothSigns, AreFoundInAShortInterval) {
  for (const double length : {1e-9, 1e-30, 1e-200}) {
    std::vector<SmoothSign> found;
    const auto f = [length](double x) -> std::array<double, 2> {
      return {(x / length - 0.3) / length, 1.0};
    };
    add_smooth_signs(f, 0.0, length, 1.0, 1.0, found);
    const std::vector<double> change = of(found, 0);
    ASSERT_EQ(change.size(), 1U) << length;
    EXPECT_NEAR(change[0] / length, 0.3, 1e-10) << length;
  }
}

}  // namespace
}  // namespace microslip::contact::test_smooth_signs
