#include "solver/curve/certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "solver/branch/start_point.hpp"
#include "solver/continuation.hpp"
#include "tests/solver/duffing.hpp"
#include "tests/support/floating_point_traps.hpp"
#include "tests/support/modal_scenes.hpp"

namespace microslip::solver::test_certificate {
namespace {

ResponsePoint certified(const Scene& scene, const Eigen::Vector3d& x, double frequency) {
  HarmonicBalance balance(scene, 1);
  NewtonResult solution;
  solution.point = {x, frequency};
  solution.evaluation = balance.evaluate(x, frequency);
  solution.converged = true;
  return certified_point(balance, solution, frequency, {});
}

// Rounding of forces at rest leaves a motion of 1e-21; damping takes energy from it that nothing
// gives.
TEST(Certificate, WithoutExcitationNoEnergyIsExchanged) {
  const Scene scene = tests::Duffing{.force = 0.0}.scene();
  for (const double frequency : {0.7, 1.0, 1.3}) {
    for (const Eigen::Vector3d& x :
         {Eigen::Vector3d(0.0, 1e-21, 0.0), Eigen::Vector3d(3e-21, -1e-21, 2e-21)}) {
      const ResponsePoint point = certified(scene, x, frequency);
      EXPECT_EQ(point.energy_imbalance, 0.0);
      EXPECT_EQ(point.dissipation_mismatch, 0.0);
    }
  }
}

// A point off the curve is still told by its energy.
TEST(Certificate, AnImbalanceBesideTheExcitationIsTold) {
  const tests::Duffing duffing{.alpha = 0.0};
  const Scene scene = duffing.scene();
  const double frequency = 1.0;  // q = −F/(2ζ) cos θ
  const double amplitude = -duffing.force / (2.0 * duffing.zeta);
  EXPECT_LT(certified(scene, {0.0, 0.0, amplitude}, frequency).energy_imbalance, 1e-14);
  EXPECT_NEAR(certified(scene, {0.0, 0.0, 0.5 * amplitude}, frequency).energy_imbalance, 0.5,
              1e-12);
}

/// On the response curve of the cubic spring, at an amplitude below its peak.
Eigen::Vector3d solution_of(const tests::Duffing& duffing, double amplitude, double frequency) {
  const double elastic = 1.0 - frequency * frequency + 0.75 * duffing.alpha * amplitude * amplitude;
  const std::complex<double> y =
      duffing.force / std::complex<double>(elastic, 2.0 * duffing.zeta * frequency);
  return {0.0, y.real(), y.imag()};
}

/// F(A, ω)² = F² at constant F: dA/dω = −∂F²/∂ω / ∂F²/∂A; phase −atan2(2ζω, 1 − ω² + ¾αA²).
TEST(Certificate, TheSlopeIsThatOfTheClosedForm) {
  const tests::Duffing duffing;
  const Scene scene = duffing.scene();
  const double frequency = 1.2;
  const double amplitude = 2.0;
  // The force that this amplitude takes: the point then lies on the curve.
  tests::Duffing on_curve = duffing;
  on_curve.force = duffing.force * std::sqrt(1.0 + duffing.defect(amplitude, frequency));
  const ResponsePoint point =
      certified(on_curve.scene(), solution_of(on_curve, amplitude, frequency), frequency);
  ASSERT_TRUE(point.slope);
  const double elastic = 1.0 - frequency * frequency + 0.75 * duffing.alpha * amplitude * amplitude;
  const double viscous = 2.0 * duffing.zeta * frequency;
  const double by_frequency =
      4.0 * amplitude * amplitude * (duffing.zeta * viscous - frequency * elastic);
  const double slope = -by_frequency / duffing.slope(amplitude, frequency);
  EXPECT_NEAR(point.amplitude, amplitude, 1e-14);
  EXPECT_NEAR(point.slope->amplitude / slope, 1.0, 1e-12);
  const double elastic_slope = -2.0 * frequency + 1.5 * duffing.alpha * amplitude * slope;
  const double phase_slope = -(2.0 * duffing.zeta * elastic - viscous * elastic_slope) /
                             (elastic * elastic + viscous * viscous);
  EXPECT_NEAR(point.slope->phase / phase_slope, 1.0, 1e-12);
}

TEST(Certificate, RestHasNoSlope) {
  const Scene scene = tests::Duffing{.force = 0.0}.scene();
  EXPECT_FALSE(certified(scene, Eigen::Vector3d::Zero(), 0.9).slope);
}

/// Another force with an error in what it says.
class FaultyForce final : public contact::ModalForce {
 public:
  struct Fault {
    double force = 0.0;      ///< relative
    double slip_work = 0.0;  ///< relative
    double event_gap = 0.0;  ///< [rad]
  };
  /// @param fault  at a motion.
  using FaultAt = std::function<Fault(const Harmonics& q, double frequency)>;

  FaultyForce(std::unique_ptr<const ModalForce> force, FaultAt fault)
      : ModalForce(force->n_modes()), force_(std::move(force)), fault_(std::move(fault)) {}
  [[nodiscard]] std::unique_ptr<Workspace> workspace() const override {
    return force_->workspace();
  }
  [[nodiscard]] contact::CycleReport report(const Harmonics& q, double frequency,
                                            Workspace& work) const override {
    contact::CycleReport report = force_->report(q, frequency, work);
    const Fault fault = fault_(q, frequency);
    report.slip_work *= 1.0 + fault.slip_work;
    report.event_gap += fault.event_gap;
    return report;
  }
  [[nodiscard]] double work_error(const Harmonics& q, double frequency,
                                  Workspace& work) const override {
    return force_->work_error(q, frequency, work);
  }
  [[nodiscard]] Eigen::MatrixXd stuck_stiffness() const override {
    return force_->stuck_stiffness();
  }

 private:
  [[nodiscard]] contact::ForceAndJacobian evaluated(const Harmonics& q, double frequency,
                                                    const contact::Asked& asked,
                                                    Workspace& work) const override {
    contact::ForceAndJacobian result = force_->evaluate(q, frequency, asked, work);
    result.force.rows() *= 1.0 + fault_(q, frequency).force;
    return result;
  }

  std::unique_ptr<const ModalForce> force_;
  FaultAt fault_;
};

constexpr double preload = 10.0;  // [N], half the force: the contact slips for a part of the period
constexpr double slips_at = 130.0;  // [rad/s], between the free and the stuck resonance

Scene with_fault(FaultyForce::FaultAt fault) {
  Scene scene = tests::chain_scene(preload);
  scene.contact = std::make_unique<FaultyForce>(std::move(scene.contact), std::move(fault));
  return scene;
}

std::string what_is_wrong(const FaultyForce::Fault& fault) {
  const Scene scene = with_fault([&](const auto&, double) { return fault; });
  const ResponseCurve curve = solve_at_frequency(scene, slips_at, {});
  EXPECT_EQ(curve.complete, curve.message.empty());
  EXPECT_EQ(curve.points.size(), curve.complete ? 1 : 0);
  EXPECT_EQ(curve.diagnosis, curve.complete ? Diagnosis::none : Diagnosis::uncertified);
  return curve.message;
}

// Row 91. Hard: a solution of a small residual whose work or order of events is wrong.
// Met in: 134 of 1 510 random curves.
// Right: it is no row; the curve says what it lacks.
//
// Of the work of friction 1e-7 is more than located events leave.
TEST(Certificate, NoRowIsMadeOfAnErrorInWorkOrOrder) {
  EXPECT_EQ(what_is_wrong({}), "");
  EXPECT_NE(what_is_wrong({.force = 1e-7}).find("dissipation mismatch"), std::string::npos);
  EXPECT_NE(what_is_wrong({.slip_work = 1e-7}).find("dissipation mismatch"), std::string::npos);
  EXPECT_NE(what_is_wrong({.event_gap = 1e-6}).find("out of order"), std::string::npos);
  const tests::UntrappedFloatingPoint compares_what_is_no_number;
  EXPECT_NE(what_is_wrong({.slip_work = std::nan("")}).find("dissipation mismatch"),
            std::string::npos);
}

// However much larger than the work the forces are that cancel in it.
TEST(Certificate, GatesThatScaleWithRoundingStillFail) {
  for (const double stiffer : {1.0, 1e3, 1e6}) {
    tests::Duffing duffing{.alpha = 0.0, .zeta = 1e-3};
    Scene scene = duffing.scene();
    scene.natural_frequency[0] = std::sqrt(stiffer);
    HarmonicBalance balance(scene, 1);
    Eigen::VectorXd x = balance.linear_response(1.001, Eigen::MatrixXd::Zero(1, 1));
    NewtonResult solution = solve_at(balance, x, 1.001, {});
    const auto objection_to = [&](const NewtonResult& to) {
      const ResponsePoint point = certified_point(balance, to, 1.001, {});
      return objection(point, gates_of(balance, point, 1e-11));
    };
    EXPECT_EQ(objection_to(solution), "");
    solution.point.x *= 1.0 + 1e-8;
    solution.evaluation = balance.evaluate(solution.point.x, 1.001);
    EXPECT_NE(objection_to(solution).find("energy imbalance"), std::string::npos) << stiffer;
    EXPECT_EQ(objection_to(solved_closer(balance, solution, Held::frequency)), "") << stiffer;
  }
}

ContinuationOptions about_the_resonance() {
  ContinuationOptions options;
  options.frequency_begin = 0.5 * slips_at;
  options.frequency_end = 2.0 * slips_at;
  return options;
}

bool has(const ResponseCurve& curve, Remedy remedy) {
  return std::ranges::find(curve.log, remedy, &SolverEvent::remedy) != curve.log.end();
}

/// Faults of `size` where the frequency is that of a row, to a share.
ResponseCurve with_fault_near(const ResponsePoint& row, double share) {
  return trace_response(
      with_fault([&, share](const auto&, double frequency) {
        const double from = std::abs(frequency - row.frequency);
        return FaultyForce::Fault{.slip_work = from <= share * row.frequency ? 1e-3 : 0.0};
      }),
      about_the_resonance(), {});
}

TEST(Certificate, ACurveGoesRoundARowWhoseProofFails) {
  const ResponseCurve whole =
      trace_response(tests::chain_scene(preload), about_the_resonance(), {});
  ASSERT_TRUE(whole.complete) << whole.message;
  const ResponseCurve curve = with_fault_near(whole.points[whole.points.size() / 2], 0.0);
  EXPECT_TRUE(curve.complete) << curve.message;
  EXPECT_TRUE(has(curve, Remedy::row_left_out));
  EXPECT_TRUE(has(curve, Remedy::other_end)) << "the rows from the other end are others";
}

TEST(Certificate, ACurveThatLacksItsPeakIsNotComplete) {
  const ResponseCurve whole =
      trace_response(tests::chain_scene(preload), about_the_resonance(), {});
  const auto peak = std::ranges::find(whole.points, PointMark::peak, &ResponsePoint::mark);
  ASSERT_NE(peak, whole.points.end());
  const ResponseCurve curve = with_fault_near(*peak, 1e-9);
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, Diagnosis::uncertified);
  EXPECT_NE(curve.message.find("1 peaks"), std::string::npos) << curve.message;
  EXPECT_NE(curve.message.find("dissipation mismatch"), std::string::npos) << curve.message;
  EXPECT_TRUE(has(curve, Remedy::row_left_out));
  EXPECT_TRUE(has(curve, Remedy::peak_unsolved));
  EXPECT_GT(std::ssize(curve.points), std::ssize(whole.points) / 2) << "it goes on to its end";
}

TEST(Certificate, ACurveEndsWhereProofsFail) {
  const ContinuationOptions options = about_the_resonance();
  const double from = 1.2 * slips_at;
  const ResponseCurve curve =
      trace_response(with_fault([&](const auto&, double frequency) {
                       const bool is_bad = frequency > from && frequency < 1.5 * slips_at;
                       return FaultyForce::Fault{.event_gap = is_bad ? 1e-3 : 0.0};
                     }),
                     options, {});
  EXPECT_FALSE(curve.complete);
  EXPECT_EQ(curve.diagnosis, Diagnosis::uncertified);
  EXPECT_NE(curve.message.find("events out of order by 0.001 rad (at most 1e-09)"),
            std::string::npos)
      << curve.message;
  for (const ResponsePoint& point : curve.points) EXPECT_EQ(point.report.event_gap < 1e-9, true);
  EXPECT_FALSE(curve.points.empty());
}

}  // namespace
}  // namespace microslip::solver::test_certificate
