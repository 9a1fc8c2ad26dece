#include "pipelines/text/rounded.hpp"

#include <gtest/gtest.h>

namespace microslip::pipelines::test_rounded {
namespace {

struct Case {
  double value, bar;
  const char* text;
};

constexpr Case cases[] = {
#include "tests/pipelines/text/half_widths.inc"
};

TEST(Rounded, HasTheDigitsOfItsHalfWidth) {
  for (const Case& one : cases) EXPECT_EQ(with_half_width(one.value, one.bar), one.text);
}

TEST(Rounded, AloneItHasTheSameDigits) {
  EXPECT_EQ(with_digits_of(278.516, 0.08), "280");
  EXPECT_EQ(with_digits_of(4.4839e-9, 0.06), "4.5e-9");
}

TEST(Rounded, WithoutAnErrorItIsWhole) {
  EXPECT_EQ(with_half_width(278.516, 0.0), "278.516");
  EXPECT_EQ(with_half_width(0.0, 0.1), "0");
}

TEST(Rounded, SharesArePercentsWithoutAnExponent) {
  EXPECT_EQ(percent_text(0.00123), "0.12 %");
  EXPECT_EQ(percent_text(0.128), "13 %");
  EXPECT_EQ(percent_text(12.72), "1272 %");
  EXPECT_EQ(signed_percent_text(1.06), "+106 %");
  EXPECT_EQ(signed_percent_text(-0.00123), "-0.12 %");
}

}  // namespace
}  // namespace microslip::pipelines::test_rounded
