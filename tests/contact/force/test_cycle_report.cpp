#include "contact/force/cycle_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "contact/closed_form/friction_cycle.hpp"
#include "contact/patch/contact_patch.hpp"
#include "contact/phase.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::test_cycle_report {
namespace {

constexpr PointParameters stuck{1.0, 0.0, 0.5, 100.0};
constexpr PointParameters slips_freely{1.0, 0.0, 0.0, 1.0};
constexpr PointParameters open{1.0, 1.0, 0.5, -5.0};
constexpr PointMotion swing{.u_sin = 1.0};

CycleReport cycle_report(const ContactPatch& patch, const std::vector<PointMotion>& motions) {
  ReportSum sum;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const FrictionCycle cycle = friction_cycle(patch.points()[i], motions[i]);
    sum.add(cycle.segments(), cycle.dissipated_energy,
            patch.weights()[static_cast<Eigen::Index>(i)]);
  }
  return sum.result();
}

TEST(CycleReport, SharesAreFractionsOfAreaTimesPeriod) {
  const ContactPatch patch(Eigen::Vector3d(1.0, 2.0, 5.0), {stuck, slips_freely, open});
  const CycleReport report = cycle_report(patch, {swing, swing, swing});
  // Sums of segments of a period: a few roundings.
  EXPECT_NEAR(report.stick_share, 1.0 / 8.0, 1e-15);
  EXPECT_NEAR(report.slip_share, 2.0 / 8.0, 1e-15);
  EXPECT_NEAR(report.separated_share, 5.0 / 8.0, 1e-15);
  EXPECT_NEAR(report.three_states_share, 1.0 / 8.0, 1e-15);
  EXPECT_EQ(report.slip_work, 0.0);
}

TEST(CycleReport, EventsOutOfOrderAreTold) {
  const auto gap = [](std::vector<CycleSegment> segments) {
    ReportSum sum;
    sum.add(segments, 0.0, 1.0);
    return sum.result().event_gap;
  };
  using enum ContactState;
  const CycleSegment first{stick, 6.0, 1.0, 0.0};
  const CycleSegment second{positive_slip, 7.0 - two_pi, two_pi - 1.0, 0.0};
  EXPECT_LT(gap({first, second}), 1e-14);
  EXPECT_LT(gap({{separated, 3.0, two_pi, 0.0}}), 1e-14);
  EXPECT_GT(gap({first, {positive_slip, 7.1 - two_pi, two_pi - 1.0, 0.0}}), 0.1);
  EXPECT_GT(gap({first, second, {stick, 6.0, 0.0, 0.0}, first, second}), two_pi - 1e-9);
  EXPECT_GT(gap({{stick, 6.0, -0.1, 0.0}, {positive_slip, 5.9, two_pi + 0.1, 0.0}}), 0.09);
  const tests::UntrappedFloatingPoint compares_what_is_no_number;
  EXPECT_TRUE(std::isnan(gap({{stick, std::nan(""), two_pi, 0.0}})));
}

// Constant load, k_u a = 2 μ n₀: slip lasts 2 (π − ψ), cos ψ = 1 − 2q/(k_u a) = 0: half the period.
TEST(CycleReport, SlipShareIsTheDurationOfSlip) {
  const ContactPatch patch(Eigen::VectorXd::Ones(1), {{1.0, 0.0, 0.5, 1.0}});
  const CycleReport report = cycle_report(patch, {swing});
  EXPECT_NEAR(report.slip_share, 0.5, 1e-15);
  EXPECT_NEAR(report.stick_share, 0.5, 1e-15);
  EXPECT_NEAR(report.slip_work, 4.0 * 0.5 * (1.0 - 0.5), 1e-15);  // 4q (a − q/k_u)
  EXPECT_EQ(report.three_states_share, 0.0);
}

// Two points that open for half the period each, in turn, with one stuck and one slipping point of
// other weights: the sweep must find the instant with the larger smallest area.
TEST(CycleReport, CoexistenceIsTheBestInstant) {
  constexpr PointParameters half_open{1.0, 1.0, 1e6, 0.0};
  const ContactPatch patch(Eigen::Vector4d(3.0, 2.0, 4.0, 1.0),
                           {half_open, half_open, slips_freely, stuck});
  const PointMotion early{.v_sin = 1.0};
  const PointMotion late{.v_sin = -1.0};
  const CycleReport report = cycle_report(patch, {early, late, swing, PointMotion{}});
  // Either 3 of 10 separated and 2 + 1 stuck, or 2 separated and 3 + 1 stuck; 4 slipping.
  EXPECT_NEAR(report.three_states_share, 0.3, 1e-15);
  EXPECT_NEAR(report.separated_share, 0.25, 1e-15);
}

TEST(CycleReport, TwoStatesInTurnAreNotThreeAtOnce) {
  const ContactPatch patch(Eigen::VectorXd::Ones(1), {{1.0, 1.0, 0.5, 0.2}});
  const CycleReport report =
      cycle_report(patch, {PointMotion{.u_sin = 2.0, .v_sin = 0.1, .v_cos = 1.0}});
  EXPECT_GT(report.stick_share, 0.0);
  EXPECT_GT(report.slip_share, 0.0);
  EXPECT_GT(report.separated_share, 0.0);
  EXPECT_EQ(report.three_states_share, 0.0);
}

TEST(CycleReport, PatchWithoutAreaHasNoShares) {
  const ContactPatch patch(Eigen::Vector2d::Zero(), {stuck, open});
  const CycleReport report = cycle_report(patch, {swing, swing});
  EXPECT_EQ(report.stick_share, 0.0);
  EXPECT_EQ(report.slip_share, 0.0);
  EXPECT_EQ(report.separated_share, 0.0);
}

}  // namespace
}  // namespace microslip::contact::test_cycle_report
