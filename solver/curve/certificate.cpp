#include "solver/curve/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "solver/balance/branch_factors.hpp"
#include "solver/balance/condensed.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/balance/period_energy.hpp"

namespace microslip::solver {
namespace {

/// y_s + i y_c of the first harmonic of the output.
std::complex<double> first_harmonic(const Harmonics& motion, const Eigen::VectorXd& output) {
  return {motion.sine().dot(output), motion.cosine().dot(output)};
}

/// dx/dω, by factors where some are at hand.
Eigen::VectorXd motion_by_frequency(const NewtonResult& at) {
  if (!at.factors) {
    return -solved(at.evaluation.jacobian, at.evaluation.parameter_derivative);
  }
  const BranchVector tangent = at.factors->tangent().direction;
  const Scaling& scaling = at.factors->scaling();
  return tangent.x * (scaling.x / (tangent.parameter * scaling.parameter));
}

/// Along (dx/dω, 1), the null vector of [∂R/∂x, ∂R/∂ω]. Empty: ∂R/∂x is singular, or nothing moves.
std::optional<BranchSlope> branch_slope(const HarmonicBalance& balance, const NewtonResult& at,
                                        const Harmonics& q, const OutputAmplitude& output) {
  if (!(output.first_harmonic > 0.0)) return std::nullopt;
  const Eigen::VectorXd& signal = balance.scene().output;
  const Harmonics change = balance.harmonics(motion_by_frequency(at));
  if (!change.rows().allFinite()) return std::nullopt;
  return BranchSlope{.amplitude = output.gradient.dot(change.vector()),
                     .phase = (first_harmonic(change, signal) / first_harmonic(q, signal)).imag()};
}

// Works below this share of |A||F| are rounding of terms that cancel: nothing is exchanged.
constexpr double vanishing = 1e-15;

}  // namespace

ResponsePoint certified_point(HarmonicBalance& balance, const NewtonResult& solution,
                              double frequency, const StabilityReport& stability) {
  const Scene& scene = balance.scene();
  ResponsePoint point;
  point.frequency = frequency;
  point.q = balance.harmonics(solution.point.x);
  point.orders = balance.set().orders();
  const OutputAmplitude output = output_amplitude(point.q, scene.output);
  point.amplitude = output.half_peak_to_peak;
  point.first_amplitude = output.first_harmonic;
  point.mean = output.mean;
  point.phase = output.phase;
  point.slope = branch_slope(balance, solution, point.q, output);
  point.residual = solution.residual;
  point.iterations = solution.iterations;
  point.stability = stability.stability;
  point.stability_basis = stability.basis;
  point.determinant_sign = stability.determinant_sign;
  point.report = balance.report(point.q, frequency);

  const double excited = period_work(point.q, balance.harmonics(balance.excitation()));
  const double damped = damping_work(point.q, scene, frequency);
  const double rubbed = period_work(point.q, balance.harmonics(solution.evaluation.contact_force));
  point.energy = {.friction = rubbed, .damping = damped};
  const double exchanged = std::max(std::abs(excited), damped + rubbed);
  const double load = balance.excitation().norm();
  // Without a load a motion is what rounding of the forces at rest leaves, and all work is that of
  // the residual.
  const double size = std::numbers::pi * point.q.vector().norm() * load;
  if (load > 0.0 && exchanged > vanishing * size) {
    point.energy_imbalance = std::abs(excited - damped - rubbed) / exchanged;
    if (scene.contact) {
      point.dissipation_mismatch = std::abs(rubbed - point.report.slip_work) / exchanged;
    }
  }
  return point;
}

}  // namespace microslip::solver
