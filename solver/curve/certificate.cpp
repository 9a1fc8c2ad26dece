#include "solver/curve/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

#include "solver/balance/branch_factors.hpp"
#include "solver/balance/condensed.hpp"
#include "solver/balance/output_amplitude.hpp"
#include "solver/balance/period_energy.hpp"
#include "solver/branch/start_point.hpp"

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

/// max(|W_exc|, W_damp + W_fric), of which the proof of a point tells shares; 0: nothing is
/// exchanged but rounding of terms that cancel. Without a load a motion is what rounding of the
/// forces at rest leaves, and all work is that of the residual.
double exchanged_work(const HarmonicBalance& balance, const Harmonics& q, double excited,
                      double taken) {
  constexpr double vanishing = 1e-15;
  const double exchanged = std::max(std::abs(excited), taken);
  const double size = std::numbers::pi * q.vector().norm() * balance.excitation().norm();
  return size > 0.0 && exchanged > vanishing * size ? exchanged : 0.0;
}

double excited_work(const HarmonicBalance& balance, const Harmonics& q) {
  return period_work(q, balance.harmonics(balance.excitation()));
}

/// Of the motion: what a force does per period is no more than its size times this [m√kg].
double path_of(const Harmonics& q) {
  double sum = 0.0;
  for (int k = 1; k <= q.n_harmonics(); ++k) {
    sum += k * std::hypot(q.sine(k).norm(), q.cosine(k).norm());
  }
  return std::numbers::pi * sum;
}

}  // namespace

ResponsePoint certified_point(HarmonicBalance& balance, const NewtonResult& solution,
                              double frequency, const StabilityReport& stability) {
  const Scene& scene = balance.scene();
  ResponsePoint point;
  point.frequency = frequency;
  point.q = balance.motion(solution.point.x, solution.evaluation);
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

  const double excited = excited_work(balance, point.q);
  const double damped = damping_work(point.q, scene, frequency);
  const double rubbed = period_work(point.q, balance.harmonics(solution.evaluation.contact_force));
  point.energy = {
      .friction = dissipated(balance, point.q, frequency, rubbed, point.report.slip_work),
      .damping = damped};
  const double exchanged = exchanged_work(balance, point.q, excited, damped + rubbed);
  if (exchanged > 0.0) {
    point.energy_imbalance = std::abs(excited - damped - rubbed) / exchanged;
    if (scene.contact) {
      point.dissipation_mismatch = std::abs(rubbed - point.report.slip_work) / exchanged;
    }
  }
  return point;
}

Gates gates_of(HarmonicBalance& balance, const ResponsePoint& point, double asked_residual) {
  constexpr double closest = customary_imbalance;
  constexpr double several = 16.0;  // roundings of the sums
  constexpr double events = 1e-9;
  constexpr double near_by = 4.0;  // rounding was taken of a point near by as this was solved
  Gates gates{asked_residual, closest, closest, events};
  const double frequency = point.frequency;
  const Eigen::VectorXd x = balance.unknowns(point.q);
  if (point.residual > asked_residual) {  // it takes about as long as a step
    const double rounded = natural_scaling(balance, x, frequency).rounding;
    gates.residual = std::max(gates.residual, near_by * rounded);
  }
  const double exchanged = exchanged_work(balance, point.q, excited_work(balance, point.q),
                                          point.energy.damping + point.energy.friction);
  if (!(exchanged > 0.0)) return gates;
  const double share = path_of(point.q) / exchanged;  // of a force in the work
  const double rounding =
      several * std::numeric_limits<double>::epsilon() * balance.largest_terms(x, frequency);
  if (point.energy_imbalance > closest) {
    gates.energy += share * (rounding + point.residual * balance.force_scale(frequency));
  }
  if (point.dissipation_mismatch > closest) {
    gates.dissipation += share * rounding + balance.work_error(point.q, frequency) / exchanged;
  }
  if (point.dissipation_mismatch > gates.dissipation) {
    gates.dissipation += share * balance.residual(x, frequency).defect;
  }
  return gates;
}

std::string objection(const ResponsePoint& point, const Gates& gates) {
  std::ostringstream text;
  text.precision(2);
  const auto compare = [&](const char* what, double value, double gate, const char* unit = "") {
    if (value <= gate) return;  // false of what is not a number
    text << (text.tellp() > 0 ? ", " : "") << what << ' ' << value << unit << " (at most " << gate
         << ')';
  };
  const bool knows_contact =
      point.report.stick_share + point.report.slip_share + point.report.separated_share > 0.0;
  compare("residual", point.residual, gates.residual);
  compare("energy imbalance", point.energy_imbalance, gates.energy);
  if (knows_contact) {
    compare("dissipation mismatch", point.dissipation_mismatch, gates.dissipation);
    compare("events out of order by", point.report.event_gap, gates.events, " rad");
  }
  return text.str();
}

NewtonResult solved_closer(HarmonicBalance& balance, const NewtonResult& solution, Held held) {
  constexpr double near = 1e-3;  // of the motion: another solution is no closer one
  const ParametricSystem system = [&](const Eigen::VectorXd& x, double frequency) {
    return balance.evaluate(x, frequency);
  };
  const bool across = held == Held::place_on_the_branch && solution.factors;
  const Scaling scaling =
      across ? solution.factors->scaling()
             : natural_scaling(balance, solution.point.x, solution.point.parameter);
  const BranchVector constraint =
      across ? solution.factors->tangent().direction
             : BranchVector{Eigen::VectorXd::Zero(solution.point.x.size()), 1.0};
  NewtonResult closer = solve_newton(system, solution.point, constraint, scaling, {});
  const bool is_near = (closer.point.x - solution.point.x).norm() <= near * solution.point.x.norm();
  if (is_near && closer.evaluation.residual.norm() < solution.evaluation.residual.norm()) {
    return closer;
  }
  NewtonResult same = solution;
  same.evaluations = closer.evaluations;
  return same;
}

}  // namespace microslip::solver
