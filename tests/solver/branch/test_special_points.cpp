// Peaks and folds that hide between two points of a branch.

#include "solver/branch/special_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "solver/branch/start_point.hpp"
#include "solver/continuation.hpp"
#include "tests/solver/duffing.hpp"
#include "tests/support/curves.hpp"
#include "tests/support/modal_scenes.hpp"
#include "tests/support/random_scene.hpp"
#include "tests/support/readable_patch.hpp"

namespace microslip::solver::test_special_points {
namespace {

using tests::frequency_range;
using tests::marked;

constexpr double two_pi = 2.0 * std::numbers::pi;

/// One harmonic of an elastic Coulomb slider (k, q = μ n₀) under a sin θ: force h in quadrature,
/// stiffness κ.
struct Slider {
  double stiffness, limit;
  [[nodiscard]] double quadrature(double a) const {
    const double least = limit / stiffness;
    return a <= least ? 0.0 : 4.0 * limit / std::numbers::pi * (1.0 - least / a);
  }
  [[nodiscard]] double in_phase(double a) const {
    const double least = limit / stiffness;
    if (a <= least) return stiffness;
    const double psi = std::acos(1.0 - 2.0 * least / a);
    return stiffness / std::numbers::pi * (psi - 0.5 * std::sin(2.0 * psi));
  }
};

/// A point on (α − ω²)²A² + (2ζω₀ωA + φh)² = F², α = ω₀² + φ²κ,
/// at which the derivative by ω is zero.
void expect_peak_of_slider(const tests::SinglePoint& single, const ResponsePoint& peak) {
  const double A = peak.amplitude;
  const double omega = peak.frequency;
  const contact::PointParameters& point = single.point;
  const Slider slider{point.tangential_stiffness, point.friction_coefficient * point.rest_load};
  const double alpha = single.frequency * single.frequency +
                       single.phi_u * single.phi_u * slider.in_phase(single.phi_u * A);
  const double damping = 2.0 * single.damping_ratio * single.frequency * A;
  const double reactive = (alpha - omega * omega) * A;
  const double active = damping * omega + single.phi_u * slider.quadrature(single.phi_u * A);
  const double F = single.force;
  EXPECT_NEAR(std::hypot(reactive, active), F, 1e-9 * F);
  // Stiffness and inertia cancel in the reactive force: their rounding is what is left of it.
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * alpha * A;
  EXPECT_NEAR(damping * active / (2.0 * omega * A), reactive, 1e-9 * F + rounding);
}

TEST(SpecialPoints, FindsThePeakWhereTheContactIsAllButStuck) {
  // The branch about the peak is an arc of nearly constant amplitude; inside of it the point
  // sticks.
  for (const double damping : {0.0, 1e-7, 3e-7, 1e-6, 1e-5, 2e-5, 1e-4}) {
    for (const double preload : {10.0, 100.0, 1000.0, 2000.0, 1e4, 1e6}) {
      SCOPED_TRACE(testing::Message() << "damping " << damping << ", preload " << preload);
      tests::SinglePoint single;
      single.frequency = 40.0 * std::numbers::pi;
      single.damping_ratio = damping;
      single.phi_u = 0.8;
      single.point = {5000.0, 0.0, 0.4, preload};
      const auto curve =
          trace_response(tests::single_point_scene(single),
                         frequency_range(0.75 * single.frequency, 1.5 * single.frequency));
      ASSERT_TRUE(curve.complete) << curve.diagnosis;
      const auto peaks = marked(curve, PointMark::peak);
      ASSERT_EQ(peaks.size(), 1U);
      expect_peak_of_slider(single, peaks[0]);
      if (damping > 0.0) continue;
      const double q = 0.4 * preload;  // (4qφ/π)(1 − q/(kφA)) = F
      const double a = q / 5000.0 / (1.0 - std::numbers::pi / (4.0 * q * 0.8));
      EXPECT_NEAR(peaks[0].amplitude, a / 0.8, 1e-9 * a);
      EXPECT_NEAR(peaks[0].phase, -0.5 * std::numbers::pi, 1e-5);
    }
  }
}

/// Four modes, three points: below its first resonance the branch folds back and, where the second
/// point stops slipping throughout, once more within a thousandth of a hertz.
Scene scene_with_four_folds() {
  Scene scene;
  scene.natural_frequency = two_pi * Eigen::Vector4d(14.427918663063945, 19.964768968754143,
                                                     32.96685223719734, 42.659584380046);
  scene.damping_ratio = Eigen::Vector4d(0.030304939987600765, 0.018938784606269375,
                                        0.01800702571869467, 0.001194422982319989);
  scene.output = Eigen::Vector4d(1.609814514035434, 0.35630476783825205, 1.624806827941641,
                                 0.7396646728405731);
  scene.excitation = Harmonics(1, 4);
  scene.excitation.rows() << -0.5160695588903406, -0.42819752031201147, -0.579808127566781,
      0.18236412585290354, -6.321993134597212, -4.325521648069932, 4.753494857062574,
      -3.177487879527643, -1.3930419247717214, 1.1253574486841067, -1.427944629586833,
      -2.5823964746614063;
  const Eigen::Vector3d weights(0.8867147419682282, 0.7800225279121171, 0.5356527804985658);
  const std::vector<contact::PointParameters> points{
      {404.0206591349239, 7315.357556580307, 0.6002341495325673, 5.167836346144506},
      {666.0443997254428, 297.0287347479413, 0.6056719792876922, 9.784980595811106},
      {4241.790832765303, 30845.456279577065, 0.7917217398518259, 10.816067827333192}};
  contact::ModalShapes shapes{Eigen::MatrixXd(3, 4), Eigen::MatrixXd(3, 4), {}};
  shapes.u << -0.7009360866758073, 0.47211462069079746, 1.214557665204409, 2.1555312784012925,
      0.8918114927656495, 1.5938426657452487, -0.4502915670052033, -0.8742169837210243,
      -1.7197732539160488, -1.1537025867459945, -0.36343371651604817, 0.1929947220841547;
  shapes.v << -0.13131005761225453, 0.08160858639308112, -0.010304893956575984,
      -0.06422010751301721, -0.07652887415836973, 0.2020688272883008, 0.01692283492877222,
      -0.08979265392629115, -0.09539822990406178, 0.18378244304667402, -0.05783508965433001,
      0.11887040918656822;
  scene.contact = std::make_unique<tests::ReadablePatch>(contact::ContactPatch(weights, points),
                                                         std::move(shapes));
  return scene;
}

TEST(SpecialPoints, FoldsCloseTogetherAreFoundByLongStepsToo) {
  const Scene scene = scene_with_four_folds();
  const auto folds = [&](double begin, double end) {
    const ResponseCurve curve =
        trace_response(scene, frequency_range(two_pi * begin, two_pi * end));
    EXPECT_TRUE(curve.complete) << curve.diagnosis;
    return marked(curve, PointMark::fold);
  };
  const auto near = folds(16.2, 16.4);  // short steps: a step is at most a tenth of the range
  ASSERT_EQ(near.size(), 4U);
  for (const auto& [begin, end] :
       {std::pair{7.2, 68.3}, std::pair{68.3, 7.2}, std::pair{16.4, 16.2}}) {
    SCOPED_TRACE(testing::Message() << begin << " to " << end << " Hz");
    auto far = folds(begin, end);
    if (begin > end) std::reverse(far.begin(), far.end());
    ASSERT_EQ(far.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(far[i].frequency, near[i].frequency, 1e-9 * near[i].frequency);
      EXPECT_NEAR(far[i].amplitude, near[i].amplitude, 1e-6 * near[i].amplitude);
    }
  }
}

/// As many marks of a kind, at the same frequencies, upwards and downwards.
void expect_either_way(tests::RandomScene random, PointMark mark, std::size_t n_marks) {
  const auto there = marked(trace_response(random.scene, random.options), mark);
  std::swap(random.options.frequency_begin, random.options.frequency_end);
  auto back = marked(trace_response(random.scene, random.options), mark);
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(there.size(), n_marks);
  ASSERT_EQ(there.size(), back.size());
  for (std::size_t i = 0; i < there.size(); ++i) {
    EXPECT_NEAR(there[i].frequency, back[i].frequency, 1e-9 * there[i].frequency);
  }
}

TEST(SpecialPoints, APeakWhereAPointBeginsToSlipIsFoundEitherWay) {
  // Cusps less than 1e-4 of the amplitude high: the slope has recovered long before the step ends.
  for (const auto& [seed, n_peaks] : {std::pair{116U, 6U}, std::pair{138U, 7U}}) {
    SCOPED_TRACE(seed);
    expect_either_way(tests::wild_scene(seed), PointMark::peak, n_peaks);
  }
}

TEST(SpecialPoints, TwoFoldsOnASteepPartAreFoundEitherWay) {
  // 3e-7 of the frequency apart, between two others.
  expect_either_way(tests::random_scene(121), PointMark::fold, 4U);
}

TEST(SpecialPoints, AHumpWhereAPointTurnsItsPhasesIsFoundEitherWay) {
  // One of 21 points turns its cycle round within a step; a valley and a peak within a long level
  // step.
  for (const auto& [seed, n_peaks] : {std::pair{402U, 4U}, std::pair{141U, 9U}}) {
    SCOPED_TRACE(seed);
    expect_either_way(tests::wild_scene(seed), PointMark::peak, n_peaks);
  }
}

TEST(SpecialPoints, APeakIsNotLowerThanThePointsBesideIt) {
  // Its valley lies within the same step, whose other end is higher.
  for (const unsigned seed : {116U, 138U}) {
    SCOPED_TRACE(seed);
    const tests::RandomScene random = tests::wild_scene(seed);
    const auto points = trace_response(random.scene, random.options).points;
    EXPECT_TRUE(std::ranges::any_of(
        points, [](const ResponsePoint& one) { return one.mark == PointMark::peak; }));
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      if (points[i].mark != PointMark::peak) continue;
      const double rounding = 1e-12 * points[i].amplitude;
      EXPECT_GE(points[i].amplitude, points[i - 1].amplitude - rounding) << i;
      EXPECT_GE(points[i].amplitude, points[i + 1].amplitude - rounding) << i;
    }
  }
}

TEST(SpecialPoints, AChangeOfSignThatCannotBeSolvedForIsGivenAndSaidSo) {
  const tests::Duffing duffing;
  const Scene scene = duffing.scene();
  HarmonicBalance balance(scene, HarmonicSet(1));
  bool broken = false;
  const ParametricSystem system = [&](const Eigen::VectorXd& x, double frequency) {
    BalanceEvaluation at = balance.evaluate(x, frequency);
    if (broken) at.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
    return at;
  };
  const ScalingRule rule = [&](const NewtonResult& at) {
    Scaling scaling = natural_scaling(balance, at.point.x, at.point.parameter);
    scaling.parameter = 0.1;
    return scaling;
  };
  StartPoint start = find_start(balance, 0.5, 1e-11);
  ASSERT_TRUE(start.solution);
  BranchWalker walker(system, rule, std::move(*start.solution), 1.0);
  std::vector<SpecialPoint> found;
  for (int i = 0; i < 1000 && found.size() < 3; ++i) {
    broken = false;
    ASSERT_TRUE(walker.advance());
    const auto solved = special_points(walker, balance);
    // Of half the step: what lies in it.
    EXPECT_EQ(
        std::ssize(special_points(walker, balance, 0.5)),
        std::ranges::count_if(solved, [](const SpecialPoint& one) { return one.share < 0.5; }));
    broken = true;
    const auto unsolved = special_points(walker, balance);
    ASSERT_EQ(unsolved.size(), solved.size());
    for (std::size_t k = 0; k < solved.size(); ++k) {
      EXPECT_TRUE(solved[k].solved);
      EXPECT_FALSE(unsolved[k].solved);
      EXPECT_EQ(unsolved[k].mark, solved[k].mark);
      EXPECT_TRUE(unsolved[k].share == 0.0 || unsolved[k].share == 1.0);
      found.push_back(unsolved[k]);
    }
  }
  EXPECT_EQ(found.size(), 3U);  // a peak, two folds
}

}  // namespace
}  // namespace microslip::solver::test_special_points
