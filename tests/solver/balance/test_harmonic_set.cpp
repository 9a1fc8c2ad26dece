#include "solver/balance/harmonic_set.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace microslip::solver::test_harmonic_set {
namespace {

TEST(HarmonicSet, AWholeNumberStandsForAllUpToIt) {
  const HarmonicSet set = 3;
  EXPECT_EQ(set.orders(), (std::vector<int>{1, 2, 3}));
  EXPECT_TRUE(set.complete());
}

TEST(HarmonicSet, AListIsSortedAndEachTakenOnce) {
  const HarmonicSet set(std::vector<int>{5, 1, 3, 5});
  EXPECT_EQ(set.orders(), (std::vector<int>{1, 3, 5}));
  EXPECT_EQ(set.highest(), 5);
  EXPECT_EQ(set.count(), 3);
  EXPECT_FALSE(set.complete());
  EXPECT_TRUE(set.contains(3));
  EXPECT_FALSE(set.contains(2));
}

TEST(HarmonicSet, UnitedHasTheOrdersOfBoth) {
  EXPECT_EQ(HarmonicSet(std::vector<int>{1, 3}).united({2, 3}), HarmonicSet(3));
  EXPECT_EQ(HarmonicSet(2).united({}), HarmonicSet(2));
}

TEST(HarmonicSet, RefusesWhatIsNoHarmonic) {
  EXPECT_THROW(HarmonicSet(0), std::invalid_argument);
  EXPECT_THROW(HarmonicSet(std::vector<int>{}), std::invalid_argument);
  EXPECT_THROW(HarmonicSet(std::vector<int>{1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::solver::test_harmonic_set
