/// The closed form against the event-locating march of tests/support, in every regime and limit.
/// Tolerance: the march is good to about 1e-17 of the force scale; the closed form sums a dozen
/// terms of that scale in double precision, each rounded at 1.1e-16, so 2e-15 holds with room and a
/// wrong branch (1e-9 at least) shows. The project asks for 1e-12.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <ostream>
#include <set>
#include <string>

#include "contact/closed_form/friction_cycle.hpp"
#include "support/cycle_cases.hpp"
#include "support/cycle_reference.hpp"
#include "tests/support/campaign.hpp"

namespace microslip::contact {

void PrintTo(const PointMotion& m, std::ostream* out) {
  out->precision(17);
  *out << "u " << m.u_mean << ' ' << m.u_sin << ' ' << m.u_cos << " v " << m.v_mean << ' '
       << m.v_sin << ' ' << m.v_cos;
}
void PrintTo(const PointParameters& p, std::ostream* out) {
  out->precision(17);
  *out << "k_u " << p.tangential_stiffness << " k_v " << p.normal_stiffness << " mu "
       << p.friction_coefficient << " preload " << p.rest_load;
}

}  // namespace microslip::contact

namespace microslip::test::test_friction_cycle_reference {
namespace {

using contact::friction_cycle;
using contact::FrictionCycle;

constexpr double coefficient_tolerance = 2e-15;

double error(const contact::ForceCoefficients& ours, const long double (&reference)[3]) {
  return static_cast<double>(
      std::max({std::abs(ours.mean - reference[0]), std::abs(ours.sin - reference[1]),
                std::abs(ours.cos - reference[2])}));
}

// Error over scale; 0 / 0 is no error.
double relative(double error, double scale) { return error == 0.0 ? 0.0 : error / scale; }

// Subnormal results are only as fine as the spacing 5e-324 of the smallest numbers.
constexpr double smallest = 1e-321;

// The march notices touch-down when the load has passed its tolerance of 1e-17; where the load only
// just touches, that takes time, and the slider is dragged along meanwhile. Forces do not see it:
// they vanish there.
double touch_down_uncertainty(const CycleCase& c) {
  const double B = c.point.normal_stiffness * std::hypot(c.motion.v_sin, c.motion.v_cos);
  const double n0 = c.point.rest_load + c.point.normal_stiffness * c.motion.v_mean;
  const double rate = std::sqrt(std::max(B - n0, 0.0)) * std::sqrt(std::max(B + n0, 0.0));
  return rate > 0.0 ? std::min(1e-8, 4e-17 * normal_scale(c) / rate) : 1e-8;
}

class CycleAgainstReference : public testing::TestWithParam<Stratum> {};

TEST_P(CycleAgainstReference, ForceCoefficientsAndEnergyAgree) {
  Random random(20260101);
  const int n_cases = tests::campaign_size(GetParam().name == "generic" ? 20000 : 4000);
  for (int i = 0; i < n_cases; ++i) {
    const CycleCase c = GetParam().draw(random);
    const FrictionCycle ours = friction_cycle(c.point, c.motion);
    const ReferenceCycle reference = reference_cycle(c.point, c.motion);
    const double f = friction_scale(c) + smallest / coefficient_tolerance;
    const double n = normal_scale(c) + smallest / coefficient_tolerance;
    ASSERT_LE(relative(error(ours.friction, reference.friction), f), coefficient_tolerance)
        << i << ": " << testing::PrintToString(c.point) << ' ' << testing::PrintToString(c.motion)
        << ' ' << reference.sequence;
    ASSERT_LE(relative(error(ours.normal, reference.normal), n), coefficient_tolerance)
        << i << ": " << testing::PrintToString(c.point) << ' ' << testing::PrintToString(c.motion);
    // Work is force times slip; slip is at most of the order of force over stiffness.
    const double slip = c.point.tangential_stiffness > 0.0 ? f / c.point.tangential_stiffness : 0.0;
    const double work =
        std::abs(static_cast<double>(ours.dissipated_energy - reference.dissipated_energy));
    ASSERT_LE(work, 20.0 * coefficient_tolerance * f * slip + smallest)
        << i << ": " << testing::PrintToString(c.point) << ' ' << testing::PrintToString(c.motion);
    const double distance =
        std::abs(static_cast<double>(ours.slip_distance - reference.slip_distance));
    ASSERT_LE(distance,
              (20.0 * coefficient_tolerance + touch_down_uncertainty(c)) * slip + smallest)
        << i << ": " << testing::PrintToString(c.point) << ' ' << testing::PrintToString(c.motion);
  }
}

TEST_P(CycleAgainstReference, SegmentsCoverThePeriodInOrder) {
  Random random(7);
  for (int i = 0; i < 4000; ++i) {
    const CycleCase c = GetParam().draw(random);
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    ASSERT_FALSE(cycle.segments().empty());
    double total = 0.0;
    double before = -1.0;
    for (const contact::CycleSegment& segment : cycle.segments()) {
      ASSERT_GT(segment.start, before);
      ASSERT_LT(segment.start, 2.0 * std::numbers::pi);
      ASSERT_GT(segment.length, 0.0);
      total += segment.length;
      before = segment.start;
    }
    ASSERT_NEAR(total, 2.0 * std::numbers::pi, 1e-14);  // a few roundings of numbers up to 2π
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, CycleAgainstReference, testing::ValuesIn(strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

// Theory section 4.4: ten sequences with separation, from touch-down on; S E for the special ones.
TEST(FrictionCycleSequences, OnlyTheTenKnownOnesOccurWithSeparation) {
  const std::set<std::string> known{"PE",   "NE",    "SPE",   "SNE",    "PSNE",
                                    "NSPE", "SPSNE", "SNSPE", "PSNSPE", "NSPSNE"};
  std::map<std::string, int> seen;
  Random random(11);
  for (int i = 0; i < 400000; ++i) {
    const CycleCase c = generic_case(random);
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    if (cycle.regime != contact::CycleRegime::separation) {
      continue;
    }
    std::string sequence;
    for (const contact::CycleSegment& segment : cycle.segments()) {
      sequence.push_back("SPNE"[static_cast<std::size_t>(segment.state)]);
    }
    const std::size_t open = sequence.find('E');
    std::rotate(sequence.begin(), sequence.begin() + static_cast<std::ptrdiff_t>(open) + 1,
                sequence.end());
    ++seen[sequence];
  }
  for (const auto& [sequence, count] : seen) {
    EXPECT_TRUE(known.contains(sequence)) << sequence << " occurred " << count << " times";
  }
  EXPECT_EQ(seen.size(), known.size());  // and each of them does
}

TEST(FrictionCycleSequences, AreThoseOfTheReference) {
  Random random(13);
  for (int i = 0; i < 3000; ++i) {
    const CycleCase c = generic_case(random);
    const FrictionCycle cycle = friction_cycle(c.point, c.motion);
    if (cycle.regime != contact::CycleRegime::separation) {
      continue;
    }
    std::string ours;
    for (const contact::CycleSegment& segment : cycle.segments()) {
      ours.push_back("SPNE"[static_cast<std::size_t>(segment.state)]);
    }
    const std::size_t open = ours.find('E');
    std::rotate(ours.begin(), ours.begin() + static_cast<std::ptrdiff_t>(open) + 1, ours.end());
    EXPECT_EQ(ours, reference_cycle(c.point, c.motion).sequence) << i;
  }
}

}  // namespace
}  // namespace microslip::test::test_friction_cycle_reference
