// The planar method against fixed-step marches in extended precision, on random orbits: several
// harmonics, different stiffness along p and r, variable load, gaps, separation.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "contact/plane/planar_cycle.hpp"
#include "support/motion_cases.hpp"
#include "support/planar_reference.hpp"
#include "tests/support/campaign.hpp"

namespace microslip::contact::test_planar_cycle_reference {
namespace {

using test::PlanarCase;

PlanarCase random_case(std::mt19937_64& random, int i) {
  std::normal_distribution<double> g;
  PlanarCase c;
  c.motion = Harmonics(1 + i % 3, 3);
  c.point = {std::exp(g(random)), std::exp(g(random)), std::exp(0.7 * g(random) - 0.5),
             1.5 * g(random) + 0.7};
  c.second_stiffness = i % 4 == 0 ? c.point.tangential_stiffness : std::exp(g(random));
  for (Eigen::Index row = 0; row < c.motion.rows().rows(); ++row) {
    for (Eigen::Index signal = 0; signal < 3; ++signal) {
      c.motion.rows()(row, signal) = g(random) / (1.0 + static_cast<double>(row / 2));
    }
  }
  return c;
}

struct Tally {
  int stick_slip = 0;
  int separation = 0;
  int sure = 0;
  double largest_sure = 0.0;
};

TEST(PlaneEventsReference, AgreesWithMarchesOnRandomOrbits) {
  std::mt19937_64 random(20260102);
  Tally tally;
  const int n_cases = tests::campaign_size(240);
  for (int i = 0; i < n_cases; ++i) {
    const PlanarCase c = random_case(random, i);
    const double scale = test::planar_scale(c);
    const PlaneEvents method(SurfaceLaw(c.point, c.second_stiffness), 1e-10);
    PointTraction traction;
    method.traction(c.motion, 1.0, traction);
    const test::PlanarReference reference = test::planar_reference(c, 512);
    double error = 0.0;
    for (std::size_t row = 0; row < reference.first.size(); ++row) {
      const auto& force = traction.force.rows().row(static_cast<Eigen::Index>(row));
      error = std::max({error, std::abs(static_cast<double>(reference.first[row]) - force[0]),
                        std::abs(static_cast<double>(reference.second[row]) - force[2])});
    }
    const auto doubt = static_cast<double>(reference.doubt);
    // The march is known to about its last extrapolation; events between its steps of 3e-3 leave
    // about the square of a step, times a few tenths.
    EXPECT_LE(error, 3.0 * doubt + 3e-6 * scale) << "case " << i;
    tally.stick_slip += traction.regime == CycleRegime::stick_slip;
    tally.separation += traction.regime == CycleRegime::separation;
    // A march that creeps towards its cycle knows little; most do not.
    if (doubt > 2e-6 * scale) continue;
    ++tally.sure;
    tally.largest_sure = std::max(tally.largest_sure, error / scale);
  }
  EXPECT_GT(tally.stick_slip, n_cases / 12);
  EXPECT_GT(tally.separation, n_cases / 4);
  EXPECT_GT(tally.sure,
            n_cases * 5 / 8);  // the marches of these are known to 2e-6; it is they that must agree
  EXPECT_LT(tally.largest_sure, 9e-6);
}

// ∮ f·dx from the coefficients and ∮ μ n |ds| from the slip phases are found in different ways.
TEST(PlaneEventsReference, WorkOfTheForceIsDissipatedBySlip) {
  std::mt19937_64 random(20260103);
  constexpr double tolerance = 1e-10;
  for (int i = 0; i < 200; ++i) {
    const PlanarCase c = random_case(random, i);
    const PlaneEvents method(SurfaceLaw(c.point, c.second_stiffness), tolerance);
    const PointHistory history =
        method.history(c.motion, 1.0, Eigen::VectorXd(), c.motion.n_harmonics());
    const double done =
        test::cycle_work(c.motion, history.force, 0) + test::cycle_work(c.motion, history.force, 2);
    const double size = c.motion.rows().bottomRows(c.motion.rows().rows() - 1).norm();
    const double scale = test::planar_scale(c) * size * c.motion.n_harmonics();
    EXPECT_NEAR(done, history.dissipated_energy, 10.0 * tolerance * scale) << "case " << i;
    EXPECT_NEAR(test::cycle_work(c.motion, history.force, 1), 0.0,
                1e-12 * (history.force.rows().norm() + 1.0));
    EXPECT_GE(history.dissipated_energy, 0.0);
  }
}

/// Cubic heights of scale R with bodies of compliance c_u, c_w in series along p and r, and a
/// coefficient that falls with the speed, all from their formulas (theory sections 10, 11).
struct RoughPoint {
  double height = 0.8;
  double first_compliance = 0.0;
  double second_compliance = 0.0;
  double slow = 0.6;
  double fast = 0.6;
};

test::SurfaceMoment moment_of(const PointParameters& point, double second_stiffness,
                              const RoughPoint& rough, long double approach, long double speed) {
  const long double R = rough.height;
  // At rest F_N = n₀: x³ − x⁴/2 = n₀/(k_v R), or beyond the heights x − ½; a gap otherwise.
  const long double at_rest = point.rest_load / (point.normal_stiffness * R);
  long double rest = at_rest;
  if (at_rest >= 0.5L) rest = at_rest + 0.5L;
  if (at_rest > 0.0L && at_rest < 0.5L) {
    long double low = 0.0L;
    long double high = 1.0L;
    for (int i = 0; i < 80; ++i) {
      const long double x = 0.5L * (low + high);
      (x * x * x * (1.0L - 0.5L * x) < at_rest ? low : high) = x;
    }
    rest = low;
  }
  const long double x = rest + approach / R;
  if (x <= 0.0L) return {x, 0.0L, {0.0L, 0.0L}};
  const long double share = x < 1.0L ? x * x * (3.0L - 2.0L * x) : 1.0L;
  const long double load =
      point.normal_stiffness * R * (x < 1.0L ? x * x * x * (1.0L - 0.5L * x) : x - 0.5L);
  const long double mu = rough.fast + (rough.slow - rough.fast) * std::exp(-0.7L * speed);
  const auto stiffness = [share](double k, double c) { return 1.0L / (1.0L / (k * share) + c); };
  return {x,
          mu * load,
          {stiffness(point.tangential_stiffness, rough.first_compliance),
           stiffness(second_stiffness, rough.second_compliance)}};
}

// Bodies that are not equally stiff along p and r make the ratio of the two stiffnesses vary with
// the load; the method must not take one for both.
TEST(PlaneEventsReference, AgreesWithMarchesOnRoughBodiesOfUnequalStiffness) {
  std::mt19937_64 random(20260104);
  std::normal_distribution<double> g;
  int sure = 0;
  int separation = 0;
  double largest_sure = 0.0;
  const int n_cases = tests::campaign_size(60, 10);
  for (int i = 0; i < n_cases; ++i) {
    PlanarCase c = random_case(random, i);
    const RoughPoint rough{0.5 + std::abs(g(random)),
                           std::exp(g(random)) / c.point.tangential_stiffness,
                           i % 5 == 0 ? 0.0 : 4.0 * std::exp(g(random)) / c.second_stiffness, 0.8,
                           i % 2 == 0 ? 0.8 : 0.4};
    const SurfaceLaw surface(
        c.point, c.second_stiffness, FrictionLaw::exponential(rough.slow, rough.fast, 0.7),
        RoughSurface::cubic(rough.height), {rough.first_compliance, 0.0, rough.second_compliance});
    c.surface = [&](long double approach, long double speed) {
      return moment_of(c.point, c.second_stiffness, rough, approach, speed);
    };
    c.point.friction_coefficient = rough.slow;
    const double scale = test::planar_scale(c);
    PointTraction traction;
    PlaneEvents(surface, 1e-10).traction(c.motion, 1.0, traction);
    const test::PlanarReference reference = test::planar_reference(c, 512);
    double error = 0.0;
    for (std::size_t row = 0; row < reference.first.size(); ++row) {
      const auto& force = traction.force.rows().row(static_cast<Eigen::Index>(row));
      error = std::max({error, std::abs(static_cast<double>(reference.first[row]) - force[0]),
                        std::abs(static_cast<double>(reference.second[row]) - force[2])});
    }
    const auto doubt = static_cast<double>(reference.doubt);
    // As above: events between the steps of the march leave the square of a step.
    EXPECT_LE(error, 3.0 * doubt + 3e-6 * scale) << "case " << i;
    separation += traction.regime == CycleRegime::separation;
    if (doubt > 2e-6 * scale) continue;
    ++sure;
    largest_sure = std::max(largest_sure, error / scale);
  }
  EXPECT_GT(sure, n_cases * 5 / 12);
  EXPECT_GT(separation, n_cases / 6);
  EXPECT_LT(largest_sure, 9e-6);
}

}  // namespace
}  // namespace microslip::contact::test_planar_cycle_reference
