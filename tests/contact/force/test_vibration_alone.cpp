#include "contact/force/vibration_alone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "contact/force/fewer_coordinates.hpp"
#include "contact/force/patch_force.hpp"
#include "contact/force/point_method_force.hpp"
#include "contact/line/line_events.hpp"
#include "tests/support/asked_force.hpp"

namespace microslip::contact::test_vibration_alone {
namespace {

constexpr double omega = 1.3;
constexpr Eigen::Index n_modes = 2;

/// Points that slip and open.
const std::vector<PointParameters> points{{2.0, 1.5, 0.4, 0.6}, {1.0, 2.5, 0.3, 0.9}};

ModalShapes shapes() {
  ModalShapes s{Eigen::MatrixXd(2, n_modes), Eigen::MatrixXd(2, n_modes), {}};
  s.u << 1.0, 0.4, 0.7, -0.6;
  s.v << 0.5, -0.3, 0.2, 0.8;
  return s;
}

std::unique_ptr<ModalForce> by_events() {
  std::vector<std::shared_ptr<const PointMethod>> methods;
  for (const PointParameters& point : points) {
    methods.push_back(std::make_shared<LineEvents>(point));
  }
  return std::make_unique<PointMethodForce>(Eigen::Vector2d(1.0, 0.5), std::move(methods),
                                            shapes());
}

std::unique_ptr<ModalForce> in_closed_form() {
  return std::make_unique<PatchForce>(ContactPatch(Eigen::Vector2d(1.0, 0.5), points), shapes());
}

/// One mode more than it has coordinates.
std::unique_ptr<ModalForce> through_coordinates() {
  Eigen::MatrixXd of_modes(n_modes, n_modes + 1);
  of_modes << 1.0, 0.2, 0.5, -0.3, 0.8, 0.4;
  return std::make_unique<FewerCoordinates>(of_modes, by_events());
}

struct Case {
  std::unique_ptr<ModalForce> (*make)();
  int n_harmonics;
};
const std::vector<Case> cases{{by_events, 3}, {in_closed_form, 1}, {through_coordinates, 3}};

Harmonics motion(int n_harmonics, Eigen::Index n) {
  Harmonics q(n_harmonics, n);
  for (Eigen::Index i = 0; i < q.rows().size(); ++i) {
    q.vector()[i] = 0.8 * std::sin(1.0 + 2.3 * static_cast<double>(i)) /
                    (1.0 + static_cast<double>(i / (3 * n)));
  }
  return q;
}

TEST(VibrationAlone, WhereTheMeanLiesIsNotSeen) {
  for (const Case& one : cases) {
    const VibrationAlone force(one.make());
    const Harmonics q = motion(one.n_harmonics, force.n_modes());
    ASSERT_GT(q.mean().norm(), 0.1);
    EXPECT_FALSE(force.answers_mean());
    EXPECT_TRUE(one.make()->answers_mean());
    const Harmonics still = without_mean(q);
    const auto inner = one.make();
    const ForceAndJacobian at = tests::evaluate(force, q, omega);
    EXPECT_EQ(at.force.vector(), tests::evaluate(*inner, still, omega).force.vector());
    EXPECT_GT((tests::evaluate(*inner, q, omega).force.vector() - at.force.vector()).norm(), 0.01);
    EXPECT_GT(at.force.mean().norm(), 1e-3) << "the mean of the force stays";
    EXPECT_EQ(tests::report(force, q, omega).slip_share,
              tests::report(*inner, still, omega).slip_share);
    const ContactStates told = tests::states(force, q, omega);
    EXPECT_FALSE(told.empty());
    EXPECT_EQ(state_change(tests::states(*inner, still, omega), told).share, 0.0);
  }
}

TEST(VibrationAlone, DerivativesAreThoseOfDifferences) {
  constexpr double step = 1e-6;
  for (const Case& one : cases) {
    const VibrationAlone force(one.make());
    const Harmonics q = motion(one.n_harmonics, force.n_modes());
    const Eigen::MatrixXd jacobian = tests::evaluate(force, q, omega).jacobian;
    Eigen::MatrixXd expected(jacobian.rows(), jacobian.cols());
    for (Eigen::Index i = 0; i < q.vector().size(); ++i) {
      Harmonics ahead = q;
      Harmonics behind = q;
      ahead.vector()[i] += step;
      behind.vector()[i] -= step;
      expected.col(i) = (tests::evaluate(force, ahead, omega).force.vector() -
                         tests::evaluate(force, behind, omega).force.vector()) /
                        (2.0 * step);
    }
    EXPECT_EQ(expected.leftCols(force.n_modes()).norm(), 0.0);
    EXPECT_LT((jacobian - expected).norm(), 1e-7 * expected.norm());
  }
}

TEST(VibrationAlone, SomeRowsAndFewerDerivativesAreThoseOfAll) {
  const VibrationAlone force(through_coordinates());
  const Harmonics q = motion(3, force.n_modes());
  const ForceAndJacobian all = tests::evaluate(force, q, omega);
  for (const std::vector<Eigen::Index>& rows :
       {std::vector<Eigen::Index>{0, 1, 2, 5, 6}, std::vector<Eigen::Index>{1, 2}}) {
    const Eigen::MatrixXd expected = restricted(all, rows).jacobian;
    const ForceAndJacobian some = tests::evaluate(force, q, omega, {.rows = rows});
    const ForceAndJacobian fewer = tests::evaluate(force, q, omega, {.rows = rows, .fewer = true});
    ASSERT_NE(fewer.fewer, nullptr);
    EXPECT_LT((some.jacobian - expected).norm(), 1e-13 * expected.norm());
    EXPECT_LT((fewer.fewer->expanded() - expected).norm(), 1e-13 * expected.norm());
  }
}

// A mean that would open every point is none of its motions.
TEST(VibrationAlone, AProofOfLinearityIsOfTheVibration) {
  const VibrationAlone force(in_closed_form());
  Harmonics q(1, n_modes);
  q.rows().row(0) << -100.0, 0.0;
  q.rows().row(1) << 1e-3, 1e-3;
  EXPECT_EQ(in_closed_form()->linear_state(q, 1e-6), LinearState::unknown);
  EXPECT_EQ(force.linear_state(q, 1e-6), LinearState::stuck);
}

}  // namespace
}  // namespace microslip::contact::test_vibration_alone
