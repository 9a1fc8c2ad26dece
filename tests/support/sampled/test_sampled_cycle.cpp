/// The sampled law against the exact one where there is one, against itself with more samples where
/// there is none, and its Jacobian against differences.
#include "tests/support/sampled/sampled_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact/line/event_law.hpp"
#include "support/motion_cases.hpp"
#include "support/surface_cases.hpp"

namespace microslip::contact {
namespace {

using test::friction_scale;
using test::MotionCase;
using test::normal_scale;
using Random = std::mt19937_64;

constexpr double pi = std::numbers::pi;
constexpr double frequency = test::surface_frequency;

PointTraction traction(const PointLaw& law, const Harmonics& motion, double omega = frequency) {
  PointTraction result;
  law.traction(motion, omega, result);
  return result;
}

using test::smooth_surface;
using MakeLaw = std::function<SurfaceLaw(const MotionCase&)>;

class SampledLaws : public testing::TestWithParam<test::SurfaceCase> {};

std::vector<MotionCase> motions(int n) {
  Random random(20260206);
  std::vector<MotionCase> cases;
  for (int i = 0; i < n; ++i) {
    const auto& stratum = test::motion_strata()[i % 2 == 0 ? 1 : 5];  // comparable, loaded
    cases.push_back(stratum.draw(random));
  }
  return cases;
}

double error(const Harmonics& a, const Harmonics& b, const MotionCase& c) {
  return std::max((a.rows().col(0) - b.rows().col(0)).cwiseAbs().maxCoeff() / friction_scale(c),
                  (a.rows().col(1) - b.rows().col(1)).cwiseAbs().maxCoeff() / normal_scale(c));
}

// Root mean square over the cases of the error at M samples.
double rms(const std::vector<MotionCase>& cases, const MakeLaw& make,
           const std::vector<Harmonics>& exact, int M) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Harmonics force = traction(SampledLaw(make(cases[i]), M), cases[i].motion).force;
    const double e = error(force, exact[i], cases[i]);
    sum += e * e;
  }
  return std::sqrt(sum / static_cast<double>(cases.size()));
}

// Theory section 8: O(1/M²); a factor 4 in M is 16 in the error, and 4 without the touch-down.
// Between them, 8, is where a random set can be told from first order.
TEST(SampledLaw, ConvergesToTheEventLawInSecondOrder) {
  const auto cases = motions(240);
  std::vector<Harmonics> exact;
  for (const MotionCase& c : cases) exact.push_back(traction(EventLaw(c.point), c.motion).force);
  const double coarse = rms(cases, smooth_surface, exact, 512);
  const double middle = rms(cases, smooth_surface, exact, 2048);
  const double fine = rms(cases, smooth_surface, exact, 8192);
  EXPECT_LT(coarse, 2e-5);
  EXPECT_GT(coarse / middle, 8.0);
  EXPECT_GT(middle / fine, 8.0);
}

TEST_P(SampledLaws, ConvergeInSecondOrder) {
  const auto cases = motions(60);
  std::vector<Harmonics> exact;
  for (const MotionCase& c : cases) {
    exact.push_back(traction(SampledLaw(GetParam().make(c), 1 << 15), c.motion).force);
  }
  const double coarse = rms(cases, GetParam().make, exact, 256);
  const double middle = rms(cases, GetParam().make, exact, 1024);
  const double fine = rms(cases, GetParam().make, exact, 4096);
  EXPECT_LT(coarse, 4e-4);
  EXPECT_GT(coarse / middle, 8.0);
  EXPECT_GT(middle / fine, 8.0);
}

// Second-order differences of the sampled force itself: exact but for rounding 1e-16/1e-6 and
// samples that change their state within the step, which differences at h and h/2 show.
TEST_P(SampledLaws, JacobianIsThatOfDifferences) {
  int n_checked = 0;
  int n_drawn = 0;
  for (const MotionCase& c : motions(60)) {
    const SampledLaw law(GetParam().make(c), 128);
    const PointTraction now = traction(law, c.motion);
    const double scale = c.point.tangential_stiffness +
                         (1.0 + c.point.friction_coefficient) * c.point.normal_stiffness;
    for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
      if (k % 3 == 2) continue;
      const auto central = [&](double h) -> Eigen::VectorXd {
        Harmonics a = c.motion;
        Harmonics b = c.motion;
        a.vector()[k] += h;
        b.vector()[k] -= h;
        return (traction(law, a).force.vector() - traction(law, b).force.vector()) / (2.0 * h);
      };
      const double h = 1e-6 * (k % 3 == 0 ? friction_scale(c) / c.point.tangential_stiffness
                                          : normal_scale(c) / c.point.normal_stiffness);
      const Eigen::VectorXd fine = central(0.5 * h);
      ++n_drawn;
      if ((central(h) - fine).cwiseAbs().maxCoeff() > 1e-7 * scale) continue;
      ASSERT_LE((now.jacobian.col(k) - fine).cwiseAbs().maxCoeff(), 1e-6 * scale) << k;
      ++n_checked;
    }
  }
  EXPECT_GT(n_checked, n_drawn / 2);
}

TEST_P(SampledLaws, FrequencyDerivativeIsThatOfDifferences) {
  int n_checked = 0;
  for (const MotionCase& c : motions(60)) {
    const SampledLaw law(GetParam().make(c), 128);
    const PointTraction now = traction(law, c.motion);
    const auto central = [&](double h) -> Eigen::VectorXd {
      return (traction(law, c.motion, frequency + h).force.vector() -
              traction(law, c.motion, frequency - h).force.vector()) /
             (2.0 * h);
    };
    const double scale = (friction_scale(c) + normal_scale(c)) / frequency;
    const Eigen::VectorXd fine = central(5e-6 * frequency);
    if ((central(1e-5 * frequency) - fine).cwiseAbs().maxCoeff() > 1e-7 * scale) continue;
    ASSERT_LE((now.frequency_derivative - fine).cwiseAbs().maxCoeff(), 1e-6 * scale);
    ++n_checked;
  }
  EXPECT_GT(n_checked, 30);
}

INSTANTIATE_TEST_SUITE_P(Laws, SampledLaws, testing::ValuesIn(test::surface_cases()),
                         [](const auto& instance) { return instance.param.name; });

TEST(SampledLaw, RateDependenceThatDoesNotChangeAnythingIsNone) {
  for (const MotionCase& c : motions(20)) {
    const double mu = c.point.friction_coefficient;
    const SurfaceLaw flat(c.point, 0.0, FrictionLaw::exponential(mu, mu, 3.0));
    const PointTraction a = traction(SampledLaw(flat, 256), c.motion);
    const PointTraction b = traction(SampledLaw(smooth_surface(c), 256), c.motion);
    EXPECT_LE(error(a.force, b.force, c), 1e-4);  // instants of turning are extra samples: O(1/M²)
    EXPECT_TRUE(a.frequency_derivative.isZero(1e-12 * friction_scale(c)));
  }
}

// Springs alone: sums over samples are exact until products of harmonics alias.
TEST(SampledLaw, AStuckPointIsExact) {
  Random random(5);
  int n_checked = 0;
  for (int i = 0; i < 300; ++i) {
    MotionCase c = test::motion_strata()[5].draw(random);
    c.point.preload *= 4.0;
    const PointTraction exact = traction(EventLaw(c.point), c.motion);
    if (exact.regime != CycleRegime::full_stick) continue;
    if (exact.jacobian(0, 0) == 0.0)
      continue;  // at an end of the band, which is met between samples
    const PointTraction now = traction(SampledLaw(smooth_surface(c), 64), c.motion);
    EXPECT_EQ(now.regime, CycleRegime::full_stick);
    EXPECT_LE(error(now.force, exact.force, c), 1e-14);  // a sum of 64 terms
    EXPECT_LE((now.jacobian - exact.jacobian).cwiseAbs().maxCoeff(),
              1e-14 * (c.point.tangential_stiffness + c.point.normal_stiffness));
    ++n_checked;
  }
  EXPECT_GT(n_checked, 50);
}

TEST(SampledLaw, EverythingIsFiniteInEveryStratum) {
  for (const test::MotionStratum& stratum : test::motion_strata()) {
    Random random(6);
    for (int i = 0; i < 150; ++i) {
      const MotionCase c = stratum.draw(random);
      const SampledLaw law(smooth_surface(c), 128);
      const PointTraction now = traction(law, c.motion);
      ASSERT_TRUE(now.force.rows().allFinite()) << stratum.name << ' ' << i;
      ASSERT_TRUE(now.jacobian.allFinite()) << stratum.name << ' ' << i;
      const PointHistory history =
          law.history(c.motion, 1.0, Eigen::VectorXd::LinSpaced(9, -7.0, 7.0), 3);
      ASSERT_TRUE(std::isfinite(history.dissipated_energy));
      ASSERT_TRUE(std::isfinite(history.slip_distance));
      for (const PointInstant& instant : history.instants) {
        ASSERT_TRUE(instant.traction.allFinite());
        ASSERT_LE(std::abs(instant.traction[0]),
                  c.point.friction_coefficient * instant.traction[1] * (1.0 + 1e-15));
      }
    }
  }
}

double length_of(const PointHistory& history, ContactState state) {
  double sum = 0.0;
  for (const CycleSegment& segment : history.segments) {
    if (segment.state == state) sum += segment.length;
  }
  return sum;
}

// Work, slip, durations and instants are of second order as well, away from events that nearly
// meet.
TEST(SampledLaw, HistoryIsThatOfTheEventLaw) {
  const Eigen::VectorXd phases = Eigen::VectorXd::LinSpaced(40, -1.0, 7.0);
  int n_checked = 0;
  for (const MotionCase& c : motions(200)) {
    const PointHistory exact = EventLaw(c.point).history(c.motion, 1.0, phases, 5);
    const bool clear = std::all_of(exact.segments.begin(), exact.segments.end(),
                                   [](const CycleSegment& s) { return s.length > 0.1; });
    if (!clear) continue;
    const PointHistory now = SampledLaw(smooth_surface(c), 4096).history(c.motion, 1.0, phases, 5);
    const double slip = friction_scale(c) / c.point.tangential_stiffness;
    EXPECT_NEAR(now.dissipated_energy, exact.dissipated_energy, 1e-5 * friction_scale(c) * slip);
    EXPECT_NEAR(now.slip_distance, exact.slip_distance, 1e-5 * slip);
    EXPECT_NEAR(now.normal_slip, exact.normal_slip, 1e-5 * normal_scale(c) * slip);
    EXPECT_EQ(now.regime, exact.regime);
    for (const ContactState state : {ContactState::stick, ContactState::positive_slip,
                                     ContactState::negative_slip, ContactState::separated}) {
      EXPECT_NEAR(length_of(now, state), length_of(exact, state), 2e-4);
    }
    double total = 0.0;
    for (const CycleSegment& segment : now.segments) total += segment.length;
    EXPECT_NEAR(total, 2.0 * pi, 1e-12);
    for (std::size_t i = 0; i < exact.instants.size(); ++i) {
      EXPECT_NEAR(now.instants[i].traction[0], exact.instants[i].traction[0],
                  1e-4 * friction_scale(c));
      EXPECT_NEAR(now.instants[i].traction[1], exact.instants[i].traction[1],
                  1e-12 * normal_scale(c));
    }
    ++n_checked;
  }
  EXPECT_GT(n_checked, 50);
}

TEST(SampledLaw, NoSpringIsNoFriction) {
  const SampledLaw law(SurfaceLaw({0.0, 1.0, 0.5, 0.3}, 0.0));
  Harmonics motion(2, 3);
  motion.rows().col(0) << 0.1, 1.0, 0.2, 0.3, 0.4;
  motion.rows().col(1) << 0.0, 0.5, 0.2, 0.3, 0.4;
  const PointHistory history = law.history(motion, 1.0, Eigen::VectorXd::Zero(1), 2);
  EXPECT_TRUE(history.force.rows().col(0).isZero(0.0));
  EXPECT_EQ(history.dissipated_energy, 0.0);
  EXPECT_EQ(history.segments.size(), 2U);
  EXPECT_EQ(law.stuck_stiffness(), Eigen::Vector3d(0.0, 1.0, 0.0));
}

TEST(SampledLaw, StiffnessAndLoadAtRest) {
  const PointParameters point{3.0, 2.0, 0.5, 7.0};
  EXPECT_EQ(SampledLaw(SurfaceLaw(point, 1.0)).stuck_stiffness(), Eigen::Vector3d(3.0, 2.0, 0.0));
  EXPECT_EQ(SampledLaw(SurfaceLaw(point, 1.0)).load_at_rest(), 7.0);
  const PointParameters gap{3.0, 2.0, 0.0, -7.0};
  EXPECT_EQ(SampledLaw(SurfaceLaw(gap, 1.0)).stuck_stiffness(), Eigen::Vector3d(0.0, 2.0, 0.0));
}

TEST(SampledLaw, TooFewSamplesAreRefused) {
  const SurfaceLaw surface({1.0, 1.0, 0.5, 1.0}, 0.0);
  EXPECT_THROW(SampledLaw(surface, 7), std::invalid_argument);
  const SampledLaw law(surface, 16);
  PointTraction result;
  EXPECT_THROW(law.traction(Harmonics(4, 3), 1.0, result), std::invalid_argument);
  EXPECT_NO_THROW(law.traction(Harmonics(3, 3), 1.0, result));
  EXPECT_THROW(static_cast<void>(law.history(Harmonics(1, 3), 1.0, {}, 8)), std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact
