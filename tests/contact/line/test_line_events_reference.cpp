/// The event law against the march of tests/support, in every regime and limit.
/// Tolerance: the march is good to about 1e-17 of the force scale; the event law sums some tens of
/// terms of that scale in double precision, each rounded at 1.1e-16 and with phases up to 4π
/// rounded at 4e-16. The project asks for 1e-12; a missed pair of events is 1e-9 at least,
/// unless it is shorter than that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "contact/line/line_events.hpp"
#include "support/motion_cases.hpp"
#include "support/motion_reference.hpp"
#include "tests/support/campaign.hpp"

namespace microslip::test::test_line_events_reference {
namespace {

using contact::LineEvents;
using contact::PointHistory;
using Random = std::mt19937_64;

constexpr double coefficient_tolerance = 4e-15;
// Subnormal results are only as fine as the spacing of the smallest numbers.
constexpr double smallest = 1e-318;

double error(const contact::Harmonics& force, int signal,
             const std::vector<long double>& reference) {
  double largest = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const long double ours = force.rows()(static_cast<Eigen::Index>(i), signal);
    largest = std::max(largest, static_cast<double>(std::abs(ours - reference[i])));
  }
  return largest;
}

std::string description(const MotionCase& c) {
  std::ostringstream text;
  text.precision(17);
  text << "k_u " << c.point.tangential_stiffness << " k_v " << c.point.normal_stiffness << " mu "
       << c.point.friction_coefficient << " preload " << c.point.rest_load << "\n"
       << c.motion.rows();
  return text.str();
}

// More than 2e4 in all; those with many phases take the reference longest.
int number_of_cases(std::string_view stratum) {
  if (stratum == "generic") return 6000;
  if (stratum == "many_harmonics" || stratum == "ripple" || stratum == "repeated") return 500;
  return 1200;
}

class LineEventsAgainstReference : public testing::TestWithParam<MotionStratum> {};

TEST_P(LineEventsAgainstReference, ForceCoefficientsAndWorkAgree) {
  Random random(20260201);
  const int n_cases = tests::campaign_size(number_of_cases(GetParam().name));
  for (int i = 0; i < n_cases; ++i) {
    const MotionCase c = GetParam().draw(random);
    const int n_harmonics = c.motion.n_harmonics() + i % 3;
    const PointHistory ours = LineEvents(c.point).history(c.motion, 1.0, {}, n_harmonics);
    const MotionReference reference = motion_reference(c.point, c.motion, n_harmonics);
    const double f = friction_scale(c);
    ASSERT_LE(error(ours.force, 0, reference.friction), coefficient_tolerance * f + smallest)
        << i << ": " << description(c) << '\n'
        << reference.sequence;
    ASSERT_LE(error(ours.force, 1, reference.normal),
              coefficient_tolerance * normal_scale(c) + smallest)
        << i << ": " << description(c) << '\n'
        << reference.sequence;
    // Work is force times slip, and there may be H times as much slip as one way there and back.
    const double slip = c.point.tangential_stiffness > 0.0
                            ? c.motion.n_harmonics() * f / c.point.tangential_stiffness
                            : 0.0;
    ASSERT_LE(std::abs(static_cast<double>(ours.dissipated_energy - reference.dissipated_energy)),
              20.0 * coefficient_tolerance * f * slip + smallest)
        << i << ": " << description(c) << '\n'
        << reference.sequence;
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, LineEventsAgainstReference, testing::ValuesIn(motion_strata()),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace microslip::test::test_line_events_reference
