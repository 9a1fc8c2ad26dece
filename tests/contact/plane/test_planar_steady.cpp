// The periodic slider of a planar point: where a stuck one comes to rest, against its closed form
// and against the plain march, and how the search ends at the onset of slip.
#include "contact/plane/planar_steady.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <Eigen/SVD>

#include <gtest/gtest.h>

#include "contact/plane/planar_cycle.hpp"
#include "contact/plane/planar_integrals.hpp"
#include "contact/plane/planar_rest.hpp"
#include "support/planar_cases.hpp"

namespace microslip::contact::test_planar_steady {
namespace {

constexpr double tight = 1e-11;

/// u = a sin θ under a limit μn₀/k = 1 with a mean w₀ across.
Harmonics straight_with_mean(double amplitude, double mean) {
  Harmonics motion(1, 3);
  motion.rows()(1, 0) = amplitude;
  motion.rows()(0, 2) = mean;
  return motion;
}

PlaneEvents unit_point() { return PlaneEvents(SurfaceLaw({1.0, 0.0, 1.0, 1.0}, 1.0), tight); }

// Discs of radius 1 around (±a, 0) meet at (0, ±√(1 − a²)): a mean larger than that is let slip
// until the spring across carries just this much. With a → 1 a march would need 1/(1 − a) periods
// and more.
TEST(PlanarSteady, AStuckPointKeepsAsMuchMeanAsItsCornerAllows) {
  for (const double gap : {0.2, 1e-2, 1e-4, 1e-6, 1e-9}) {
    const double a = 1.0 - gap;
    for (const double mean : {0.9, 3.0, -40.0}) {
      PointTraction traction;
      unit_point().traction(straight_with_mean(a, mean), 1.0, traction);
      const double held = std::copysign(std::sqrt(gap * (2.0 - gap)), mean);
      EXPECT_EQ(traction.regime, CycleRegime::full_stick);
      // Rounding of the radius moves the corner by 1e-16/held.
      const double tolerance = tight + 1e-15 / std::abs(held);
      EXPECT_NEAR(traction.force.mean()[2], held, tolerance) << "gap " << gap;
      EXPECT_NEAR(traction.force.rows()(1, 0), a, tolerance);
      EXPECT_NEAR(traction.force.mean()[0], 0.0, tolerance);
      // d held / d a = −a / held; the mean itself no longer matters.
      const double slope = -a / held;
      EXPECT_NEAR(traction.jacobian(2, 3), slope, 1e-7 * std::abs(slope));
      EXPECT_NEAR(traction.jacobian(2, 2), 0.0, 1e-12);
    }
  }
}

// Beyond the onset no mean is held. Slip by `excess` brings the mean down by that share of it a
// period, so that the period map is next to the identity: what it does is summed from the slip
// itself.
TEST(PlanarSteady, ASlippingPointHoldsNoMeanAcrossAStraightMotion) {
  for (const double excess : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    PointTraction traction;
    unit_point().traction(straight_with_mean(1.0 + excess, 2.0), 1.0, traction);
    EXPECT_EQ(traction.regime, CycleRegime::stick_slip);
    EXPECT_NEAR(traction.force.mean()[2], 0.0, 2.0 * tight) << "excess " << excess;  // scale 2
    EXPECT_EQ(traction.defect, 0.0);
  }
}

/// The largest |K x| of an onset case over its limit: it can rest up to 1.
double onset_size(const test::PlanarCase& c) {
  Eigen::Matrix2d force;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double k = i == 0 ? c.point.tangential_stiffness : c.second_stiffness;
    force.row(i) = k * c.motion.rows().col(2 * i).tail<2>().transpose();
  }
  const double limit = c.point.friction_coefficient * c.point.rest_load;
  return Eigen::JacobiSVD<Eigen::Matrix2d>(force).singularValues()[0] / limit;
}

// Motion of one harmonic under constant load reverses after half a period: no mean is held, however
// near the onset of slip, and whether there is slip is known.
TEST(PlanarSteady, NoMeanIsHeldNextToTheOnsetOfSlip) {
  std::mt19937_64 random(7);
  int slipping = 0;
  for (int i = 0; i < 4000; ++i) {
    const test::PlanarCase c = test::onset_planar(random);
    PointTraction traction;
    PlaneEvents(SurfaceLaw(c.point, c.second_stiffness), tight).traction(c.motion, 1.0, traction);
    const bool slips = onset_size(c) > 1.0;
    EXPECT_EQ(traction.regime, slips ? CycleRegime::stick_slip : CycleRegime::full_stick) << i;
    if (!slips) continue;
    ++slipping;
    const double mean =
        std::max(std::abs(traction.force.mean()[0]), std::abs(traction.force.mean()[2]));
    EXPECT_LE(mean, 10.0 * tight * test::planar_scale(c)) << i;
    EXPECT_EQ(traction.defect, 0.0) << i;
  }
  EXPECT_GT(slipping, 1800);
}

/// The same motion with another tangential amplitude.
test::PlanarCase amplified(test::PlanarCase c, double factor) {
  auto moving = c.motion.rows().bottomRows(c.motion.rows().rows() - 1);
  moving.col(0) *= factor;
  moving.col(2) *= factor;
  return c;
}

/// Least excess of any slider.
double least_excess(const test::PlanarCase& c) {
  const SurfaceLaw law(c.point, c.second_stiffness);
  const PlanarMotion motion(law, c.motion, 1.0);
  return best_rest(motion, planar_intervals(motion), motion.virgin_slider()).excess;
}

/// The amplitude beyond which no slider rests, as a factor.
double onset_factor(const test::PlanarCase& c) {
  double low = 0.0;
  double high = 1.0;
  while (least_excess(amplified(c, high)) <= 0.0) low = std::exchange(high, 2.0 * high);
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (least_excess(amplified(c, middle)) > 0.0 ? high : low) = middle;
  }
  return high;
}

// Several harmonics and load that varies, down to 1e-9 of the amplitude from where rest becomes
// impossible: three and more windows, thin valleys, a window that comes and goes between two
// sliders.
TEST(PlanarSteady, SearchesNextToAnyOnsetMeetTheirTolerance) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> digits(-9.0, -1.0);
  for (int i = 0; i < 150; ++i) {
    const test::PlanarCase drawn = test::creeping_planar(random);
    const double side = random() % 2 == 0 ? -1.0 : 1.0;
    const double aside = side * std::pow(10.0, digits(random));
    const test::PlanarCase c = amplified(drawn, onset_factor(drawn) * (1.0 + aside));
    PointTraction traction;
    PointTraction loose;
    const SurfaceLaw surface(c.point, c.second_stiffness);
    PlaneEvents(surface, tight).traction(c.motion, 1.0, traction);
    PlaneEvents(surface, 1e-9).traction(c.motion, 1.0, loose);
    EXPECT_EQ(traction.regime, aside > 0.0 ? CycleRegime::stick_slip : CycleRegime::full_stick)
        << i;
    EXPECT_EQ(traction.defect, 0.0) << i;
    const Eigen::VectorXd apart = traction.force.vector() - loose.force.vector();
    EXPECT_LE(apart.cwiseAbs().maxCoeff(), 1e-8 * test::planar_scale(c)) << i;  // ten tolerances
  }
}

// Never more than that: the rest of the period is walked roughly, and the defect bounds what it
// misses.
TEST(PlanarSteady, AWalkThatRunsOutOfStepsSaysSo) {
  std::mt19937_64 random(57);
  for (int i = 0; i < 20; ++i) {
    const test::PlanarCase c = test::slipping_planar(random);
    const SurfaceLaw law(c.point, c.second_stiffness);
    const PlanarMotion motion(law, c.motion, 1.0);
    const std::vector<PlanarInterval> intervals = planar_intervals(motion);
    OrbitOptions options{tight, static_cast<double>(c.motion.n_harmonics())};
    const SteadyOrbit exact = steady_orbit(motion, intervals, options);
    options.most_steps = 4 - 200 * c.motion.n_harmonics();
    const SteadyOrbit steady = steady_orbit(motion, intervals, options);
    EXPECT_EQ(exact.orbit.defect, 0.0) << i;
    ASSERT_GT(steady.defect, 0.0) << i;
    EXPECT_FALSE(steady.closes) << i;
    EXPECT_LE(steady.orbit.pieces.size(), 8U + intervals.size()) << i;
    EXPECT_EQ(steady.orbit.pieces.back().end, intervals.back().end) << i;
    const int H = c.motion.n_harmonics();
    const Harmonics rough = planar_force(motion, intervals, steady.orbit, H);
    const Harmonics fine = planar_force(motion, intervals, exact.orbit, H);
    EXPECT_LE((rough.rows() - fine.rows()).cwiseAbs().maxCoeff(),
              steady.defect * motion.force_scale())
        << i;
  }
}

struct March {
  Eigen::Vector2d slider = Eigen::Vector2d::Zero();
  bool settled = false;
};

/// Period by period from the virgin slider, without any help.
March long_march(const PlanarMotion& motion, const std::vector<PlanarInterval>& intervals,
                 const OrbitOptions& options, int most_periods) {
  March march{motion.virgin_slider(), false};
  for (int period = 0; period < most_periods && !march.settled; ++period) {
    const PlanarOrbit orbit = walk_orbit(motion, intervals, march.slider, options);
    const double moved = motion.stiffness().cwiseProduct(orbit.end - march.slider).norm();
    march.slider = orbit.end;
    march.settled = !orbit.slips || moved < 1e-15;
  }
  return march;
}

struct Tally {
  int corners = 0;
  int settled = 0;
  int at_rest = 0;
};

void compare(const test::PlanarCase& c, int i, Tally& tally) {
  const SurfaceLaw law(c.point, c.second_stiffness);
  const PlanarMotion motion(law, c.motion, 1.0);
  const std::vector<PlanarInterval> intervals = planar_intervals(motion);
  const OrbitOptions options{tight, static_cast<double>(c.motion.n_harmonics())};
  const SteadyOrbit steady = steady_orbit(motion, intervals, options);
  if (steady.regime != CycleRegime::full_stick) return;
  const March march = long_march(motion, intervals, options, 1000);
  tally.corners += steady.corner.has_value();
  if (!march.settled) return;
  ++tally.settled;
  tally.at_rest += !steady.corner.has_value();
  const Eigen::Vector2d apart = motion.stiffness().cwiseProduct(steady.orbit.begin - march.slider);
  // The march sums the errors of its walks.
  EXPECT_LT(apart.norm(), 100.0 * tight) << "case " << i;
}

TEST(PlanarSteady, AStuckPointEndsWhereTheMarchEnds) {
  std::mt19937_64 random(3);
  Tally tally;
  for (int i = 0; i < 400; ++i) {
    compare(test::dragged_planar(random), i, tally);
    compare(test::creeping_planar(random), i, tally);
  }
  EXPECT_GT(tally.corners, 20);
  EXPECT_GT(tally.at_rest, 200);
  EXPECT_GT(tally.settled, 400);
}

TEST(PlanarSteady, TheCornerMovesAsItsDerivativeSays) {
  std::mt19937_64 random(4);
  int tested = 0;
  for (int i = 0; i < 400; ++i) {
    test::PlanarCase c = test::creeping_planar(random);
    const SurfaceLaw surface(c.point, c.second_stiffness);
    const PlaneEvents law(surface, tight);
    const PlanarMotion motion(surface, c.motion, 1.0);
    const SteadyOrbit steady = steady_orbit(motion, planar_intervals(motion), {tight, 3.0});
    if (!steady.corner.has_value()) continue;
    ++tested;
    PointTraction traction;
    law.traction(c.motion, 1.0, traction);
    const double size = c.motion.rows().cwiseAbs().maxCoeff();
    const double step = 1e-6 * size;
    for (Eigen::Index j = 0; j < c.motion.vector().size(); ++j) {
      PointTraction right;
      PointTraction left;
      Harmonics moved = c.motion;
      moved.vector()[j] += step;
      law.traction(moved, 1.0, right);
      moved.vector()[j] -= 2.0 * step;
      law.traction(moved, 1.0, left);
      const Eigen::VectorXd expected = (right.force.vector() - left.force.vector()) / (2.0 * step);
      // The corner has a curvature of its own, large where the two edges meet at a small angle.
      EXPECT_LT((expected - traction.jacobian.col(j)).norm(), 1e-4 * traction.jacobian.norm())
          << "case " << i << ", column " << j;
    }
  }
  EXPECT_GT(tested, 10);
}

/// Motions from one to another, share 0 to 1.
struct Line {
  test::PlanarCase from;
  Harmonics way;

  struct Point {
    Eigen::VectorXd force;
    Eigen::VectorXd slope;  ///< by the share
  };
  [[nodiscard]] Point at(double share) const {
    Harmonics motion = from.motion;
    motion.rows() += share * way.rows();
    PointTraction traction;
    PlaneEvents(SurfaceLaw(from.point, from.second_stiffness)).traction(motion, 1.0, traction);
    const double scale = test::planar_scale(from);
    return {traction.force.vector() / scale, traction.jacobian * way.vector() / scale};
  }
  [[nodiscard]] Eigen::VectorXd force_at(double share) const { return at(share).force; }
  /// What is left of the largest change between two shares when they meet: 0 of a continuous force.
  [[nodiscard]] double jump_between(double low, double high) const {
    Eigen::VectorXd before = force_at(low);
    Eigen::VectorXd after = force_at(high);
    while (high - low > 1e-14) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      const Eigen::VectorXd between = force_at(middle);
      if ((between - before).norm() > (after - between).norm()) {
        high = middle;
        after = between;
      } else {
        low = middle;
        before = between;
      }
    }
    return (after - before).norm();
  }
};

Line random_line(const test::PlanarStratum& stratum, std::mt19937_64& random) {
  Line line{stratum.draw(random), {}};
  line.way = line.from.motion;
  const double amplitude = line.from.motion.rows().cwiseAbs().maxCoeff();
  std::uniform_real_distribution<double> size(-3.0, -0.5);
  std::normal_distribution<double> normal;
  const double length = amplitude * std::pow(10.0, size(random));
  for (double& x : line.way.vector()) x = length * normal(random);
  return line;
}

// Where stuck throughout becomes possible the periodic slider is no longer one but any of a lens of
// them, and Newton's method on the period map may come to its edge from outside, with slip of 1e-14
// that looked like a regime of its own: the force jumped by percents. At the onset itself the mean
// that is held goes like the root of the distance: 1e-14 of the way leaves 1e-7 of it, times the
// length of the way.
TEST(PlanarSteady, ForcesFollowTheMotionWithoutJumps) {
  constexpr int n_steps = 50;
  constexpr double width = 1.0 / n_steps;
  int looked_at = 0;
  double largest = 0.0;
  for (const test::PlanarStratum& stratum : test::planar_strata()) {
    if (stratum.name != "onset" && stratum.name != "dragged") continue;
    std::mt19937_64 random(7);
    for (int i = 0; i < 80; ++i) {
      const Line line = random_line(stratum, random);
      Line::Point before = line.at(0.0);
      for (int step = 1; step <= n_steps; ++step) {
        Line::Point now = line.at(step * width);
        // A kink between them changes the force by no more than the slopes differ.
        const Eigen::VectorXd mean = 0.5 * width * (before.slope + now.slope);
        const double kink = 0.5 * width * (now.slope - before.slope).norm();
        if ((now.force - before.force - mean).norm() > 1.2 * kink + 1e-6) {
          largest = std::max(largest, line.jump_between((step - 1) * width, step * width));
          ++looked_at;
        }
        before = std::move(now);
      }
    }
  }
  EXPECT_GT(looked_at, 20);
  EXPECT_LT(largest, 1e-6);
}

// Long random searches: what is not met is said, and hardly anything is not met.
TEST(PlanarSteady, HardlyAnySearchEndsBeforeItsTolerance) {
  std::mt19937_64 random(9);
  int unmet = 0;
  for (int i = 0; i < 500; ++i) {
    for (const test::PlanarStratum& stratum : test::planar_strata()) {
      const test::PlanarCase c = stratum.draw(random);
      PointTraction traction;
      PlaneEvents(SurfaceLaw(c.point, c.second_stiffness), tight).traction(c.motion, 1.0, traction);
      EXPECT_TRUE(traction.force.vector().allFinite() && traction.jacobian.allFinite());
      EXPECT_TRUE(traction.defect == 0.0 || traction.defect > 0.01 * tight) << stratum.name;
      unmet += traction.defect > 0.0;
    }
  }
  EXPECT_LE(unmet, 1);
}

}  // namespace
}  // namespace microslip::contact::test_planar_steady
