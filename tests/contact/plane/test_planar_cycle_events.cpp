// The planar events against cycles whose events are located in extended precision and whose slip is
// integrated to order twelve: several harmonics, different stiffness along p and r, separation,
// coefficients that fall with the speed within a small part of the period.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "contact/plane/planar_cycle.hpp"
#include "support/planar_cases.hpp"
#include "support/planar_events.hpp"
#include "tests/support/campaign.hpp"

namespace microslip::contact::test_planar_cycle_events {
namespace {

using test::EventCase;
using test::EventReference;

/// Generic states and such as never separate; every other pair with friction that depends on the
/// rate.
EventCase draw(std::mt19937_64& random, int i) {
  EventCase c{test::planar_strata()[static_cast<std::size_t>(i % 2)].draw(random)};
  std::uniform_real_distribution<double> digits(-1.0, 3.0);
  if (i % 4 < 2) return c;
  c.kinetic = 0.5 * c.point.point.friction_coefficient;
  c.rate = std::pow(10.0, digits(random));
  return c;
}

SurfaceLaw surface_of(const EventCase& c) {
  const double mu = c.point.point.friction_coefficient;
  const FrictionLaw friction =
      c.rate > 0.0 ? FrictionLaw::exponential(mu, c.kinetic, c.rate) : FrictionLaw::constant(mu);
  return {c.point.point, c.point.second_stiffness, friction};
}

/// Of the friction of a law with a tolerance, relative to the force scale.
double error_of(const EventCase& c, const EventReference& reference, double tolerance) {
  PointTraction traction;
  PlaneEvents(surface_of(c), tolerance).traction(c.point.motion, 1.0, traction);
  double error = 0.0;
  for (std::size_t i = 0; i < reference.first.size(); ++i) {
    const auto& force = traction.force.rows().row(static_cast<Eigen::Index>(i));
    error = std::max({error, std::abs(static_cast<double>(reference.first[i]) - force[0]),
                      std::abs(static_cast<double>(reference.second[i]) - force[2])});
  }
  return error / test::planar_scale(c.point);
}

TEST(PlaneEventsTolerance, ForcesAreThoseOfLocatedEvents) {
  std::mt19937_64 random(81);
  const int n_cases = tests::campaign_size(60, 12);
  int sure = 0;
  int slips = 0;
  for (int i = 0; i < n_cases; ++i) {
    const EventCase c = draw(random, i);
    const EventReference reference = test::planar_events(c, 20);
    // Sliders that still creep after so many periods are known by the period map alone.
    if (!reference.settled) continue;
    ++sure;
    slips += reference.n_slips;
    // Largest of 300: 3e-12.
    EXPECT_LE(error_of(c, reference, 1e-12), 1e-11) << i;
  }
  EXPECT_GT(sure, n_cases * 9 / 10);
  EXPECT_GT(slips, n_cases);
}

// What a tolerance promises, slow points included.
TEST(PlaneEventsTolerance, TolerancesAreMet) {
  std::mt19937_64 random(82);
  const int n_cases = tests::campaign_size(16, 4);
  for (int i = 0; i < n_cases; ++i) {
    const EventCase c = draw(random, i);
    const EventReference reference = test::planar_events(c, 20);
    if (!reference.settled) continue;
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      EXPECT_LE(error_of(c, reference, tolerance), 10.0 * tolerance) << i;
    }
  }
}

}  // namespace
}  // namespace microslip::contact::test_planar_cycle_events
