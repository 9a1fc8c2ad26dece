// Branches that end: a spring whose force jumps by c where the amplitude passes 1. With c > 0 no
// solution exists for a range of frequencies, with c < 0 the branches overlap; either way Newton's
// method can do nothing at the edge, and what happens then is logged and named.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "solver/continuation.hpp"
#include "tests/support/full_force.hpp"

namespace microslip::solver::test_remedies {
namespace {

class JumpingForce final : public tests::FullForce {
 public:
  explicit JumpingForce(double jump) : FullForce(1), jump_(jump) {}
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return Eigen::MatrixXd::Zero(1, 1);
  }
  [[nodiscard]] contact::CycleReport report(const Harmonics& /*q*/, double /*frequency*/,
                                            Workspace& /*work*/) const override {
    return {};
  }
  [[nodiscard]] contact::ForceAndJacobian by_all(const Harmonics& q,
                                                 double /*frequency*/) const override {
    contact::ForceAndJacobian result;
    result.force = Harmonics(1, 1);
    result.jacobian = Eigen::MatrixXd::Zero(3, 3);
    result.frequency_derivative = Eigen::VectorXd::Zero(3);
    const Eigen::Vector2d x(q.rows()(1, 0), q.rows()(2, 0));
    const double size = x.norm();
    if (size < 1.0) return result;
    result.force.vector().tail(2) = jump_ / size * x;
    result.jacobian.bottomRightCorner(2, 2) =
        jump_ / size * (Eigen::Matrix2d::Identity() - x * x.transpose() / (size * size));
    return result;
  }

 private:
  double jump_;
};

/// Towards a resonance at 1 rad/s: amplitude 1 at ω² = 1 − F = 0.8.
Scene jumping(double jump) {
  Scene scene;
  scene.natural_frequency = Eigen::VectorXd::Ones(1);
  scene.damping_ratio = Eigen::VectorXd::Constant(1, 0.001);
  scene.output = Eigen::VectorXd::Ones(1);
  scene.excitation = Harmonics(1, 1);
  scene.excitation.rows()(1, 0) = 0.2;
  scene.contact = std::make_unique<JumpingForce>(jump);
  return scene;
}

ContinuationOptions below_resonance() {
  ContinuationOptions options;
  options.frequency_begin = 0.5;
  options.frequency_end = 0.97;
  return options;
}

bool logged(const ResponseCurve& curve, Remedy remedy) {
  return std::any_of(curve.log.begin(), curve.log.end(),
                     [&](const SolverEvent& event) { return event.remedy == remedy; });
}

TEST(Remedies, AreNotNeededBySmoothCurves) {
  const ResponseCurve curve = trace_response(jumping(0.0), below_resonance());
  EXPECT_TRUE(curve.complete);
  EXPECT_TRUE(curve.log.empty());
}

TEST(Remedies, CrossASmallGapInTheBranch) {
  // No solution for 0.2 − c < 1 − ω² < 0.2: 0.0225 rad/s, longer than the steps there.
  ContinuationOptions range = below_resonance();
  range.frequency_begin = 0.05;
  range.frequency_end = 1.05;
  const ResponseCurve curve = trace_response(jumping(0.04), range);
  EXPECT_TRUE(curve.complete) << curve.diagnosis << ": " << curve.message;
  EXPECT_TRUE(logged(curve, Remedy::fixed_frequency) || logged(curve, Remedy::homotopy));
  EXPECT_FALSE(logged(curve, Remedy::other_branch));
  ASSERT_FALSE(curve.log.empty());
  EXPECT_NEAR(curve.log.back().frequency, std::sqrt(0.8), 1e-5);
  for (const ResponsePoint& point : curve.points) {
    EXPECT_LE(point.residual, 1e-11);
  }
}

TEST(Remedies, NameTheGapThatNothingCrosses) {
  const ResponseCurve curve = trace_response(jumping(0.1), below_resonance());
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, Diagnosis::event_chatter) << curve.message;
  ASSERT_FALSE(curve.points.empty());
  for (const ResponsePoint& point : curve.points) {
    EXPECT_TRUE(point.q.vector().allFinite());
    EXPECT_LE(point.residual, 1e-11);
  }
}

TEST(Remedies, NameTheBranchThatTheyJumpTo) {
  // Beyond amplitude 1 the force helps: 1.5 times the amplitude, on another branch.
  const ResponseCurve curve = trace_response(jumping(-0.1), below_resonance());
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, Diagnosis::branch_jump) << curve.message;
  EXPECT_TRUE(logged(curve, Remedy::other_branch));
  EXPECT_DOUBLE_EQ(curve.points.back().frequency, below_resonance().frequency_end);
}

TEST(WorkOfACurve, IsTheSumOfItsPoints) {
  const ResponseCurve curve = trace_response(jumping(0.0), below_resonance());
  long evaluations = 0;
  double seconds = 0.0;
  for (const ResponsePoint& point : curve.points) {
    EXPECT_GT(point.contact_evaluations, 0);
    evaluations += point.contact_evaluations;
    seconds += point.seconds;
  }
  EXPECT_EQ(evaluations, curve.contact_evaluations);
  EXPECT_LE(seconds, curve.seconds);
  EXPECT_GT(seconds, 0.0);
}

}  // namespace
}  // namespace microslip::solver::test_remedies
