#include "pipelines/text/rounded.hpp"

#include <gtest/gtest.h>

namespace microslip::pipelines::test_rounded {
namespace {

TEST(Rounded, HasTheDigitsOfItsHalfWidth) {
  EXPECT_EQ(with_half_width(278.516, 0.062), "279 ± 17");
  EXPECT_EQ(with_half_width(278.516, 0.08), "280 ± 20");
  EXPECT_EQ(with_digits_of(278.516, 0.08), "280");
  EXPECT_EQ(with_half_width(0.000448394, 0.062), "0.00045 ± 0.00003");
  EXPECT_EQ(with_half_width(330.78, 0.0205), "331 ± 7");
  EXPECT_EQ(with_half_width(330.78, 1.3e-4), "330.78 ± 0.04");
  EXPECT_EQ(with_half_width(1234.5, 0.5), "1200 ± 600");
}

TEST(Rounded, SmallAndLargeNumbersHaveOneExponent) {
  EXPECT_EQ(with_half_width(4.4839e-9, 0.06), "(4.5 ± 0.3)e-9");
  EXPECT_EQ(with_half_width(-2.345e11, 0.01), "(-2.35 ± 0.02)e11");
}

TEST(Rounded, WithoutAnErrorItIsWhole) {
  EXPECT_EQ(with_half_width(278.516, 0.0), "278.516");
  EXPECT_EQ(with_half_width(0.0, 0.1), "0");
}

}  // namespace
}  // namespace microslip::pipelines::test_rounded
