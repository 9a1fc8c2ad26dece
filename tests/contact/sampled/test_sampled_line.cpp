/// The patch in lanes along one direction, against located events, where these are exact, and its
/// Jacobian against differences of its own force; smooth surfaces, whose kinks are mended,
/// in third order and without jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "contact/line/line_events.hpp"
#include "contact/line/surface_line_events.hpp"
#include "contact/sampled/patch_force.hpp"
#include "one_point.hpp"
#include "support/motion_cases.hpp"
#include "support/surface_cases.hpp"
#include "tests/support/asked_force.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::sampled::test_sampled_line {
namespace {

// Lanes compute what they then do not take.
[[maybe_unused]] const tests::UntrappedFile this_file(__FILE__);

using test::friction_scale;
using test::modal;
using test::MotionCase;
using test::normal_scale;
using test::one_point;
using Random = std::mt19937_64;
constexpr double frequency = test::surface_frequency;

std::vector<MotionCase> motions(int n) {
  Random random(20260206);
  std::vector<MotionCase> cases;
  for (int i = 0; i < n; ++i) {
    const auto& stratum = test::motion_strata()[i % 2 == 0 ? 1 : 5];  // comparable, loaded
    cases.push_back(stratum.draw(random));
  }
  return cases;
}

PointTraction traction(const PointMethod& method, const Harmonics& motion) {
  PointTraction result;
  method.traction(motion, frequency, result);
  result.force.rows()(0, 1) -= method.reference_load();
  return result;
}

double error(const Harmonics& a, const Harmonics& b, const MotionCase& c) {
  return std::max((a.rows().col(0) - b.rows().col(0)).cwiseAbs().maxCoeff() / friction_scale(c),
                  (a.rows().col(1) - b.rows().col(1)).cwiseAbs().maxCoeff() / normal_scale(c));
}

double rms(const std::vector<MotionCase>& cases, const test::SurfaceCase& surface,
           const std::vector<Harmonics>& exact, int n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Harmonics q = modal(cases[i].motion, 2);
    const auto force = tests::evaluate(one_point(surface.make(cases[i]), 2, n), q, frequency, {});
    sum += std::pow(error(force.force, exact[i], cases[i]), 2);
  }
  return std::sqrt(sum / static_cast<double>(cases.size()));
}

class LineSurfaces : public testing::TestWithParam<test::SurfaceCase> {};

// Theory section 8: O(n⁻²): four times as many instants, a sixteenth of the error. 8 tells a random
// set from first order.
TEST_P(LineSurfaces, ConvergeToLocatedEventsInSecondOrder) {
  const auto cases = motions(40);
  std::vector<Harmonics> exact;
  for (const MotionCase& c : cases) {
    exact.push_back(traction(SurfaceLineEvents(GetParam().make(c)), c.motion).force);
  }
  const double coarse = rms(cases, GetParam(), exact, 128);
  const double middle = rms(cases, GetParam(), exact, 512);
  const double fine = rms(cases, GetParam(), exact, 2048);
  std::printf("rms error at 128, 512, 2048 instants: %.2e %.2e %.2e\n", coarse, middle, fine);
  EXPECT_LT(coarse, 1e-3);
  // 256 in second order, 16 in first, 64 between them. A coefficient that rises with the speed has
  // a sharp least where the motion turns, between two instants: where that holds the slider the
  // order is one.
  EXPECT_GT(coarse / fine, GetParam().name == "rising" ? 16.0 : 64.0);
}

TEST_P(LineSurfaces, SlipWorkConvergesToThatOfLocatedEvents) {
  const auto cases = motions(40);
  const auto rms_error = [&](int n) {
    double sum = 0.0;
    for (const MotionCase& c : cases) {
      const SurfaceLaw surface = GetParam().make(c);
      const double exact =
          SurfaceLineEvents(surface).history(c.motion, frequency, {}, 1).dissipated_energy;
      const PatchForce patch = one_point(surface, 2, n);
      const double slip = tests::report(patch, modal(c.motion, 2), frequency).slip_work;
      const double scale = friction_scale(c) * c.motion.rows().col(0).norm();
      sum += std::pow((slip - exact) / scale, 2);
    }
    return std::sqrt(sum / static_cast<double>(cases.size()));
  };
  const double coarse = rms_error(128);
  const double fine = rms_error(2048);
  std::printf("rms error of the slip work at 128, 2048 instants: %.2e %.2e\n", coarse, fine);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_GT(coarse / fine, 64.0);  // 256 in second order, 16 in first
}

/// Of many harmonics, so that phases are as short as ten instants.
std::vector<MotionCase> rippled_motions(int n, int n_harmonics) {
  Random random(7);
  std::normal_distribution<double> normal;
  std::vector<MotionCase> cases = motions(n);
  for (MotionCase& c : cases) {
    Harmonics motion(n_harmonics, c.motion.rows().cols());
    motion.rows().topRows(3) = c.motion.rows().topRows(3);
    for (Eigen::Index row = 3; row < motion.rows().rows(); ++row) {
      const auto k = static_cast<double>((row + 1) / 2);
      for (Eigen::Index signal = 0; signal < 2; ++signal) {
        const double size = c.motion.rows().col(signal).norm();
        motion.rows()(row, signal) = 0.3 * normal(random) / (k * k) * size;
      }
    }
    c.motion = std::move(motion);
  }
  return cases;
}

// kinks.hpp (1): from 128 to 2048 instants 4096 in third order, 256 in second.
TEST(SampledLine, SmoothSurfacesConvergeInThirdOrder) {
  const test::SurfaceCase smooth{"smooth", test::smooth_surface};
  for (const auto& cases : {motions(40), rippled_motions(40, 9)}) {
    std::vector<Harmonics> exact;
    for (const MotionCase& c : cases) {
      exact.push_back(traction(LineEvents(c.point), c.motion).force);
    }
    const double coarse = rms(cases, smooth, exact, 128);
    const double fine = rms(cases, smooth, exact, 2048);
    std::printf("rms error at 128, 2048 instants: %.2e %.2e\n", coarse, fine);
    EXPECT_LT(coarse, 1e-5);
    EXPECT_GT(coarse / fine, 1000.0);
  }
}

double friction_limit(const MotionCase& c) {
  return c.point.friction_coefficient * normal_scale(c);
}

/// Begun by an angle later.
void begin_later(Harmonics& motion, double angle) {
  for (int k = 1; k <= motion.n_harmonics(); ++k) {
    const Eigen::RowVectorXd sine = motion.rows().row(2 * k - 1);
    const Eigen::RowVectorXd cosine = motion.rows().row(2 * k);
    motion.rows().row(2 * k - 1) = std::cos(k * angle) * sine - std::sin(k * angle) * cosine;
    motion.rows().row(2 * k) = std::cos(k * angle) * cosine + std::sin(k * angle) * sine;
  }
}

/// Where u is largest.
double top_of(const Harmonics& motion) {
  constexpr int n = 100000;
  double top = 0.0;
  double highest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    double u = 0.0;
    for (int k = 1; k <= motion.n_harmonics(); ++k) {
      u += motion.rows()(2 * k - 1, 0) * std::sin(k * angle) +
           motion.rows()(2 * k, 0) * std::cos(k * angle);
    }
    if (u > highest) {
      highest = u;
      top = angle;
    }
  }
  return top;
}

/// That slip through nearly the whole period: a stick lasts down to a hundredth of a step of 128,
/// in every second case around an instant.
std::vector<MotionCase> deep_motions(int n) {
  Random random(19);
  std::vector<MotionCase> cases = rippled_motions(n, 3);
  for (MotionCase& c : cases) {
    const double size = c.motion.rows().col(0).norm() * c.point.tangential_stiffness;
    const double ratio = std::pow(10.0, std::uniform_real_distribution(1.0, 6.0)(random));
    c.motion.rows().col(0) *= ratio * friction_limit(c) / size;
    const double step = 2.0 * std::numbers::pi / 128.0;
    const double off = std::uniform_real_distribution(-0.1, 0.1)(random);
    if ((&c - cases.data()) % 2 == 0) begin_later(c.motion, top_of(c.motion) + off * step);
  }
  return cases;
}

std::vector<MotionCase> joined(std::vector<MotionCase> a, const std::vector<MotionCase>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Against the limit of friction: root mean square and largest.
std::array<double, 2> limit_error(const std::vector<MotionCase>& cases, int n) {
  double sum = 0.0;
  double largest = 0.0;
  for (const MotionCase& c : cases) {
    const Harmonics exact = traction(LineEvents(c.point), c.motion).force;
    const PatchForce patch = one_point(test::smooth_surface(c), 2, n);
    const Harmonics now = tests::evaluate(patch, modal(c.motion, 2), frequency, {}).force;
    const double own =
        (now.rows().col(0) - exact.rows().col(0)).cwiseAbs().maxCoeff() / friction_limit(c);
    sum += own * own;
    largest = std::max(largest, own);
  }
  return {std::sqrt(sum / static_cast<double>(cases.size())), largest};
}

// Without both kinks of a stick it errs by its share of a step: 1e-2.
TEST(SampledLine, StickShorterThanAStepIsSummed) {
  const auto cases = deep_motions(400);
  const auto [coarse, largest] = limit_error(cases, 128);
  const auto [fine, largest_fine] = limit_error(cases, 1024);
  std::printf("error at 128, 1024 instants: rms %.2e %.2e, largest %.2e %.2e\n", coarse, fine,
              largest, largest_fine);
  EXPECT_LT(coarse, 2e-4);
  EXPECT_LT(largest, 1e-3);
  EXPECT_GT(coarse / fine, 100.0);  // 512 in third order, 64 in second
}

/// That slip nearly throughout and turn up to twice from one of 128 instants to the next.
std::vector<MotionCase> twice_turning_motions(int n) {
  std::vector<MotionCase> cases = rippled_motions(n, 15);
  for (MotionCase& c : cases) {
    for (int k = 2; k <= 15; ++k) c.motion.rows().middleRows(2 * k - 1, 2).col(0) *= std::sqrt(k);
    const double size = c.motion.rows().col(0).norm() * c.point.tangential_stiffness;
    c.motion.rows().col(0) *= 1e5 * friction_limit(c) / size;
  }
  return cases;
}

// The kinks of such a step are as large as the spring could pull, 1e5 times the limit, and cancel
// each other: one that is missed errs by some of that.
TEST(SampledLine, TwoTurnsWithinAStepLeaveNoKinkAlone) {
  const auto [rms, largest] = limit_error(twice_turning_motions(2000), 128);
  std::printf("error at 128 instants: rms %.2e, largest %.2e\n", rms, largest);
  EXPECT_LT(largest, 0.1);
}

// What the slider does is what friction does over the cycle, here that of located events.
TEST(SampledLine, SlipWorkOfSmoothSurfacesConverges) {
  const auto rms_error = [](const std::vector<MotionCase>& cases, int n) {
    double sum = 0.0;
    for (const MotionCase& c : cases) {
      const Harmonics force = traction(LineEvents(c.point), c.motion).force;
      const double work = test::cycle_work(c.motion, force, 0);
      PatchForce patch = one_point(test::smooth_surface(c), 2, n);
      const double slip = tests::report(patch, modal(c.motion, 2), frequency).slip_work;
      const double scale = friction_scale(c) * c.motion.rows().col(0).norm();
      sum += std::pow((slip - work) / scale, 2);
    }
    return std::sqrt(sum / static_cast<double>(cases.size()));
  };
  for (const auto& cases : {motions(40), rippled_motions(40, 9)}) {
    const double coarse = rms_error(cases, 128);
    const double fine = rms_error(cases, 1024);
    std::printf("rms error of the slip work at 128, 1024 instants: %.2e %.2e\n", coarse, fine);
    EXPECT_LT(coarse, 1e-5);
    EXPECT_GT(coarse / fine, 200.0);  // 512 in third order, 64 in second
  }
}

double stiffness_scale(const MotionCase& c) {
  return c.point.tangential_stiffness +
         (1.0 + c.point.friction_coefficient) * c.point.normal_stiffness;
}

/// Root mean square over random directions, relative.
double jacobian_error(const std::vector<MotionCase>& cases, int n) {
  Random random(11);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  for (const MotionCase& c : cases) {
    PatchForce force = one_point(test::smooth_surface(c), 2, n);
    const Harmonics q = modal(c.motion, 2);
    const Eigen::VectorXd way =
        Eigen::VectorXd::NullaryExpr(q.vector().size(), [&] { return normal(random); });
    const double h = 1e-6 * normal_scale(c) / c.point.normal_stiffness;
    Harmonics ahead = q;
    Harmonics behind = q;
    ahead.vector() += h * way;
    behind.vector() -= h * way;
    const Eigen::VectorXd slope = (tests::evaluate(force, ahead, frequency, {}).force.vector() -
                                   tests::evaluate(force, behind, frequency, {}).force.vector()) /
                                  (2.0 * h);
    const Eigen::VectorXd product = tests::evaluate(force, q, frequency).jacobian * way;
    sum += (product - slope).squaredNorm() / std::pow(stiffness_scale(c) * way.norm(), 2);
  }
  return std::sqrt(sum / static_cast<double>(cases.size()));
}

/// That never open.
std::vector<MotionCase> pressed(std::vector<MotionCase> cases) {
  for (MotionCase& c : cases) c.point.rest_load += 1.1 * normal_scale(c);
  return cases;
}

// Slip that begins and ends alone: an eighth per doubling, a quarter without what moves its place.
TEST(SampledLine, JacobianOfPressedSmoothSurfacesErrsInThirdOrder) {
  const auto cases = pressed(joined(rippled_motions(60, 9), deep_motions(60)));
  const double coarse = jacobian_error(cases, 128);
  const double fine = jacobian_error(cases, 512);
  std::printf("rms error of the Jacobian at 128, 512 instants: %.2e %.2e\n", coarse, fine);
  EXPECT_GT(coarse / fine, 32.0);
}

// What the derivatives of opening and closing leave out: a quarter per doubling.
TEST(SampledLine, JacobianOfSmoothSurfacesErrsInSecondOrder) {
  const auto cases = joined(rippled_motions(60, 9), deep_motions(60));
  const double coarse = jacobian_error(cases, 128);
  const double fine = jacobian_error(cases, 512);
  std::printf("rms error of the Jacobian at 128, 512 instants: %.2e %.2e\n", coarse, fine);
  EXPECT_LT(coarse, 3e-4);
  EXPECT_GT(coarse / fine, 8.0);
}

// A curve needs a force without jumps: where a kink, a turn or a landing passes an instant the sums
// go on. Motions with a stick of one instant between two slips may jump by the order of the error.
TEST(SampledLine, SmoothSurfacesDoNotJumpWhereKinksPassInstants) {
  constexpr int n_steps = 100;
  Random random(13);
  std::normal_distribution<double> normal;
  int n_jumps = 0;
  double largest = 0.0;
  for (const MotionCase& c : joined(rippled_motions(20, 9), deep_motions(20))) {
    PatchForce force = one_point(test::smooth_surface(c), 2, 128);
    const Harmonics q = modal(c.motion, 2);
    Eigen::VectorXd way =
        Eigen::VectorXd::NullaryExpr(q.vector().size(), [&] { return normal(random); });
    way *= 0.0025 * q.vector().norm() / way.norm();
    const auto at = [&](double share) -> Eigen::VectorXd {
      Harmonics moved = q;
      moved.vector() += share * way;
      return tests::evaluate(force, moved, frequency, {}).force.vector() /
             (friction_scale(c) + normal_scale(c));
    };
    Eigen::VectorXd before = at(0.0);
    for (int i = 1; i <= n_steps; ++i) {
      double low = static_cast<double>(i - 1) / n_steps;
      double high = static_cast<double>(i) / n_steps;
      Eigen::VectorXd left = before;
      Eigen::VectorXd right = before = at(high);
      // What is left of a step of 1e-5 after a thousandth of it is a jump.
      for (int halving = 0; halving < 10; ++halving) {
        const double middle = 0.5 * (low + high);
        Eigen::VectorXd here = at(middle);
        const bool in_left = (here - left).norm() > (right - here).norm();
        (in_left ? high : low) = middle;
        (in_left ? right : left) = std::move(here);
      }
      const double jump = (right - left).norm();
      largest = std::max(largest, jump);
      if (jump > 1e-6) ++n_jumps;
    }
  }
  std::printf("%d jumps in %d steps, the largest %.1e\n", n_jumps, 40 * n_steps, largest);
  EXPECT_LE(n_jumps, 2);
  EXPECT_LT(largest, 1e-4);
}

// Central differences of the sampled force itself: exact but for rounding 1e-16/1e-6 and instants
// that change their state within the step, which differences at h and h/2 show.
TEST_P(LineSurfaces, JacobianIsThatOfDifferences) {
  int n_checked = 0;
  int n_drawn = 0;
  for (const MotionCase& c : motions(30)) {
    PatchForce force = one_point(GetParam().make(c), 2, 128);
    const Harmonics q = modal(c.motion, 2);
    const ForceAndJacobian now = tests::evaluate(force, q, frequency);
    const double scale = stiffness_scale(c);
    // Of smooth surfaces complete but for what is of second order: see above.
    const double allowed = GetParam().make(c).is_smooth() ? 2e-3 : 1e-6;
    for (Eigen::Index k = 0; k < now.jacobian.cols(); ++k) {
      const auto central = [&](double h) -> Eigen::VectorXd {
        Harmonics a = q;
        Harmonics b = q;
        a.vector()[k] += h;
        b.vector()[k] -= h;
        return (tests::evaluate(force, a, frequency, {}).force.vector() -
                tests::evaluate(force, b, frequency, {}).force.vector()) /
               (2.0 * h);
      };
      const double h = 1e-6 * (k % 2 == 0 ? friction_scale(c) / c.point.tangential_stiffness
                                          : normal_scale(c) / c.point.normal_stiffness);
      const Eigen::VectorXd fine = central(0.5 * h);
      ++n_drawn;
      if ((central(h) - fine).cwiseAbs().maxCoeff() > 1e-7 * scale) continue;
      ASSERT_LE((now.jacobian.col(k) - fine).cwiseAbs().maxCoeff(), allowed * scale) << k;
      ++n_checked;
    }
  }
  EXPECT_GT(n_checked, n_drawn / 2);
}

TEST_P(LineSurfaces, FrequencyDerivativeIsThatOfDifferences) {
  int n_checked = 0;
  for (const MotionCase& c : motions(30)) {
    PatchForce force = one_point(GetParam().make(c), 2, 128);
    const Harmonics q = modal(c.motion, 2);
    const ForceAndJacobian now = tests::evaluate(force, q, frequency);
    const auto central = [&](double h) -> Eigen::VectorXd {
      return (tests::evaluate(force, q, frequency + h, {}).force.vector() -
              tests::evaluate(force, q, frequency - h, {}).force.vector()) /
             (2.0 * h);
    };
    const double scale = (friction_scale(c) + normal_scale(c)) / frequency;
    const Eigen::VectorXd fine = central(5e-6 * frequency);
    if ((central(1e-5 * frequency) - fine).cwiseAbs().maxCoeff() > 1e-7 * scale) continue;
    ASSERT_LE((now.frequency_derivative - fine).cwiseAbs().maxCoeff(), 1e-6 * scale);
    ++n_checked;
  }
  EXPECT_GT(n_checked, 15);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, LineSurfaces, testing::ValuesIn(test::surface_cases()),
                         [](const auto& instance) { return instance.param.name; });

// Section 4.2: a virgin slider, clipped into its band. Points that are pushed are not asleep; where
// the band is met between instants its end errs by O(n⁻³).
TEST(SampledLine, FullStickKeepsTheConventionOfTheLineEvents) {
  Random random(5);
  int n_free = 0;
  int n_pushed = 0;
  for (int i = 0; i < 300; ++i) {
    MotionCase c = test::motion_strata()[5].draw(random);
    c.point.rest_load *= i % 2 == 0 ? 4.0 : 2.0;
    c.motion.rows()(0, 0) *= i % 2 == 0 ? 1.0 : 8.0;
    const PointTraction exact = traction(LineEvents(c.point), c.motion);
    if (exact.regime != CycleRegime::full_stick) continue;
    const Harmonics q = modal(c.motion, 2);
    const ForceAndJacobian now =
        tests::evaluate(one_point(test::smooth_surface(c), 2, 256), q, 1.0);
    const bool pushed = exact.jacobian(0, 0) == 0.0;
    ++(pushed ? n_pushed : n_free);
    EXPECT_LE(error(now.force, exact.force, c), pushed ? 1e-5 : 1e-14);
    EXPECT_NEAR(now.jacobian(0, 0), exact.jacobian(0, 0), 1e-12 * c.point.tangential_stiffness);
  }
  std::printf("free %d, pushed %d\n", n_free, n_pushed);
  EXPECT_GT(n_free, 30);
  EXPECT_GT(n_pushed, 10);
}

TEST(SampledLine, EveryStratumIsFiniteAndNearLocatedEvents) {
  for (const test::MotionStratum& stratum : test::motion_strata()) {
    Random random(6);
    double worst = 0.0;
    for (int i = 0; i < 40; ++i) {
      const MotionCase c = stratum.draw(random);
      if (!(friction_scale(c) > 1e-250)) continue;  // no unit of force is that small
      const Harmonics q = modal(c.motion, 2);
      const ForceAndJacobian now =
          tests::evaluate(one_point(test::smooth_surface(c), 2, 512), q, 1.0);
      ASSERT_TRUE(now.force.rows().allFinite()) << stratum.name << ' ' << i;
      ASSERT_TRUE(now.jacobian.allFinite()) << stratum.name << ' ' << i;
      worst = std::max(worst, error(now.force, traction(LineEvents(c.point), c.motion).force, c));
    }
    std::printf("%-22s %.1e\n", std::string(stratum.name).c_str(), worst);
    EXPECT_LT(worst, 1e-5) << stratum.name;
  }
}

}  // namespace
}  // namespace microslip::contact::sampled::test_sampled_line
