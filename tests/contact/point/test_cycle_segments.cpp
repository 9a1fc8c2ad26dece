#include "contact/point/cycle_segments.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace microslip::contact::test_cycle_segments {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

TEST(CycleSegments, PhasesAreWrappedIntoOneTurn) {
  EXPECT_EQ(wrapped_phase(0.0), 0.0);
  EXPECT_EQ(wrapped_phase(two_pi), 0.0);
  EXPECT_NEAR(wrapped_phase(-1.0), two_pi - 1.0, 1e-15);
  EXPECT_NEAR(wrapped_phase(7.0), 7.0 - two_pi, 1e-15);
  EXPECT_LT(wrapped_phase(-1e-17), two_pi);
}

TEST(CycleSegments, NeighboursOfOneStateBecomeOneAcrossTheEndToo) {
  const auto joined = joined_segments({{ContactState::stick, 4.0, 1.0},
                                       {ContactState::positive_slip, 5.0, 1.0},
                                       {ContactState::positive_slip, 6.0, 1.0},
                                       {ContactState::stick, 7.0, two_pi - 3.0}},
                                      1e-12);
  ASSERT_EQ(joined.size(), 2U);
  EXPECT_EQ(joined[0].state, ContactState::stick);
  EXPECT_NEAR(joined[0].start, 7.0 - two_pi, 1e-14);
  EXPECT_NEAR(joined[0].length, two_pi - 2.0, 1e-14);
  EXPECT_EQ(joined[1].state, ContactState::positive_slip);
  EXPECT_EQ(joined[1].start, 5.0);
  EXPECT_EQ(joined[1].length, 2.0);
}

TEST(CycleSegments, PhasesOfRoundingBelongToTheOneBefore) {
  const auto joined = joined_segments({{ContactState::stick, 1.0, 3.0},
                                       {ContactState::negative_slip, 4.0, 1e-15},
                                       {ContactState::separated, 4.0, two_pi - 3.0}},
                                      1e-12);
  ASSERT_EQ(joined.size(), 2U);
  EXPECT_EQ(joined[0].state, ContactState::stick);
  EXPECT_EQ(joined[1].state, ContactState::separated);
}

}  // namespace
}  // namespace microslip::contact::test_cycle_segments
