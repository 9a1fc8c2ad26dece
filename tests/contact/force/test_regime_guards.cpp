#include "contact/force/regime_guards.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "contact/closed_form/cycle_phases.hpp"
#include "contact/closed_form/friction_cycle.hpp"
#include "contact/patch/point_motions.hpp"

namespace microslip::contact {
namespace {

// One mode per component: the motion of every point is chosen freely through its shapes.
ModalShapes shapes_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  ModalShapes shapes{Eigen::MatrixXd(p.size(), 2), Eigen::MatrixXd(p.size(), 2), {}};
  shapes.u << p, r;
  shapes.v << 0.6 * r, 0.8 * p;
  return shapes;
}

std::vector<PointParameters> parameters_at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) {
  std::vector<PointParameters> points;
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    points.push_back({1.0, 1.2, 0.5, 0.8 * r[i] + 0.4 * p[i] * p[i]});
  }
  return points;
}

Harmonics random_state(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Harmonics q(1, 2);
  for (double& x : q.vector()) {
    x = normal(random);
  }
  return q;
}

// The states of a cycle from its first contact on, as letters.
std::string sequence(const PointParameters& point, const PointMotion& motion) {
  const SlipFunctions w = slip_functions(point, motion);
  std::string letters;
  const CyclePhases phases = cycle_phases(w, cycle_regime(w));
  for (int i = 0; i < phases.n_phases; ++i) {
    const CyclePhase& phase = phases.phase[static_cast<std::size_t>(i)];
    if (phase.length > 1e-9) {  // zero lengths are not phases
      letters += phase.kind == PhaseKind::separated       ? 'E'
                 : phase.kind == PhaseKind::positive_slip ? 'P'
                 : phase.kind == PhaseKind::negative_slip ? 'N'
                                                          : 'S';
    }
  }
  return letters;
}

// The first state after contact and the last before separation, which the sequence guards speak of.
std::string ends(const std::string& letters) {
  return letters.size() < 2 ? letters : std::string{letters.front(), letters[letters.size() - 2]};
}

TEST(RegimeGuards, HaveTheSignsOfTheRegimes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  int seen[4] = {};
  for (int k = 0; k < 2000; ++k) {
    const Harmonics q = random_state(random);
    const Eigen::VectorXd p = Eigen::VectorXd::Constant(1, uniform(random));
    const Eigen::VectorXd r = Eigen::VectorXd::Constant(1, 1.5 * uniform(random) + 1.5);
    const Eigen::RowVectorXd guard = regime_guards(shapes_at, parameters_at, {q}).values(p, r);
    const CycleRegime regime =
        friction_cycle(parameters_at(p, r)[0], point_motions(shapes_at(p, r), q)[0]).regime;
    const CycleRegime expected = guard[2] <= 0.0   ? CycleRegime::separated
                                 : guard[1] > 0.0  ? CycleRegime::separation
                                 : guard[0] <= 0.0 ? CycleRegime::full_stick
                                                   : CycleRegime::stick_slip;
    EXPECT_EQ(regime, expected);
    ++seen[static_cast<int>(regime)];
  }
  for (const int count : seen) {
    EXPECT_GT(count, 5);
  }
}

// Along short steps of the patch the first and last state of a contact change only where a guard
// does.
TEST(RegimeGuards, ChangeSignWhereTheSequenceOfStatesChanges) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int changes = 0;
  int unseen = 0;
  for (int k = 0; k < 200; ++k) {
    const Harmonics q = random_state(random);
    const Guards guards = regime_guards(shapes_at, parameters_at, {q});
    const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(2000, uniform(random), uniform(random));
    const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(2000, uniform(random), uniform(random));
    const Eigen::MatrixXd values = guards.values(p, r);
    const std::vector<PointMotion> motions = point_motions(shapes_at(p, r), q);
    const std::vector<PointParameters> points = parameters_at(p, r);
    std::string before;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const std::string now = ends(sequence(points[i], motions[i]));
      const auto row = static_cast<Eigen::Index>(i);
      const bool both_separate = i > 0 && values(row, 1) > 0.0 && values(row - 1, 1) > 0.0 &&
                                 values(row, 2) > 0.0 && values(row - 1, 2) > 0.0;
      if (both_separate && now != before) {
        ++changes;
        const Eigen::Array2d first = values.block<1, 2>(row - 1, 5).transpose();
        const Eigen::Array2d second = values.block<1, 2>(row, 5).transpose();
        unseen += (first * second > 0.0).all() ? 1 : 0;
      }
      before = now;
    }
  }
  EXPECT_GT(changes, 300);
  // Where L₁ or L₂ nearly vanishes its angle turns through both ends of contact within one step.
  EXPECT_LT(unseen, changes / 50) << changes;
}

TEST(RegimeGuards, StandSideBySideForSeveralStates) {
  std::mt19937_64 random(7);
  const Harmonics a = random_state(random);
  const Harmonics b = random_state(random);
  const Eigen::VectorXd p = Eigen::VectorXd::LinSpaced(5, -1.0, 1.0);
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(5, 0.5, 2.0);
  const Guards both = regime_guards(shapes_at, parameters_at, {a, b});
  const Eigen::MatrixXd values = both.values(p, r);
  const Eigen::Index n = values.cols() / 2;
  ASSERT_EQ(static_cast<std::size_t>(2 * n), both.lines.size());
  EXPECT_EQ(values.leftCols(n), regime_guards(shapes_at, parameters_at, {a}).values(p, r));
  EXPECT_EQ(values.rightCols(n), regime_guards(shapes_at, parameters_at, {b}).values(p, r));
  EXPECT_EQ(both.lines[static_cast<std::size_t>(n) + 3].domain, n);
}

}  // namespace
}  // namespace microslip::contact
