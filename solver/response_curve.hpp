/// @file
/// Solution points of a scene over frequency, in branch order, each with its proof: residual,
/// energy balance, stability.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact/harmonics.hpp"
#include "contact/modal_force.hpp"
#include "solver/diagnosis.hpp"

namespace microslip::solver {

using contact::Harmonics;

enum class PointMark { none, peak, fold };
/// 1, 0, −1 in files.
enum class Stability { unstable = 0, stable = 1, not_assessed = -1 };

/// What a verdict of stability rests on (stability.hpp). Hill's exponents do not prove that pairs
/// of a hysteretic force decay: what they call stable is not proved stable.
enum class StabilityBasis { slow_flow, hill, period_map, damped_linear };

/// What a period takes from the excitation [J].
struct PeriodEnergy {
  /// ∬∮ μn|ds| dA: the dissipated energy. Of rough surfaces it is not the work of the contact's
  /// force, since their stiffness follows the load.
  double friction = 0.0;
  double damping = 0.0;  ///< W_damp, of the viscous damping of the modes
};

/// How the output goes on along the branch.
struct BranchSlope {
  double amplitude = 0.0;  ///< d(amplitude)/dω [m s]
  double phase = 0.0;      ///< d(phase)/dω [s]
};

/// Harmonics that may do anything are left out: one may resonate somewhere along the curve.
inline constexpr double all_left_out = 1.0;

struct ResponsePoint {
  double frequency = 0.0;   ///< ω [rad/s]
  Harmonics q;              ///< [m√kg]
  std::vector<int> orders;  ///< harmonics that were unknowns beside the mean; empty: all of q
  double harmonics_left_out =
      0.0;                       ///< what those left out change, over the amplitude; 0: not asked
  double amplitude = 0.0;        ///< half the peak-to-peak value of the output over the period [m]
  double first_amplitude = 0.0;  ///< first harmonic of the output [m]
  double mean = 0.0;             ///< mean of the output [m]
  double phase = 0.0;            ///< atan2(y_c, y_s) of the first harmonic [rad]
  /// Empty: at a fold, where the branch turns back, and of motions that are integrated.
  std::optional<BranchSlope> slope;
  double residual = 0.0;          ///< relative to max(excitation, contact force of the stuck limit)
  double energy_imbalance = 0.0;  ///< |W_exc − W_damp − W_fric| / max(|W_exc|, W_damp + W_fric)
  double dissipation_mismatch = 0.0;  ///< |W_fric − ∬∮ μn|ds| dA| over the same
  PeriodEnergy energy;
  contact::CycleReport report;
  Stability stability = Stability::not_assessed;
  StabilityBasis stability_basis = StabilityBasis::slow_flow;
  double determinant_sign = 0.0;  ///< of ∂R/∂q
  PointMark mark = PointMark::none;
  int iterations = 0;  ///< Newton steps of this point's own solution
  long contact_evaluations =
      0;                 ///< since the point before: steps that failed, peaks and folds included
  double seconds = 0.0;  ///< of work since the point before
};

/// Called after each accepted point; false stops the curve (diagnosis "interrupted").
using PointObserver = std::function<bool(const ResponsePoint&)>;

/// A remedy that was needed and helped.
struct SolverEvent {
  double frequency = 0.0;  ///< [rad/s], where it began
  Remedy remedy = Remedy::shorter_step;
};

/// A branch that the sweep does not meet: it coexists with the curve.
struct DetachedBranch {
  std::vector<ResponsePoint> points;  ///< in branch order
  /// An isola: the last point is next to the first. Else both ends leave the range, or the range is
  /// one frequency and the branch one point.
  bool closed = false;
};

/// The highest peak solved for with more harmonics than its curve has.
struct SettledPeak {
  double frequency = 0.0;          ///< [rad/s]
  double amplitude = 0.0;          ///< [m]; 0: none
  double left_out = 0.0;           ///< Σ |δA| / A of harmonics beyond, estimated
  double dissipated_energy = 0.0;  ///< by friction in a period [J]
  bool is_end = false;             ///< of the range, where it is no peak
};

struct ResponseCurve {
  std::vector<ResponsePoint> points;  ///< converged points only
  bool complete = false;
  Diagnosis diagnosis = Diagnosis::none;
  std::string message;  ///< a sentence with the numbers
  /// Empty, or what was proved instead of solved: the linear limit is a solution over the whole
  /// range, or rest.
  std::string certificate;
  std::vector<SolverEvent> log;          ///< remedies in the order they were needed
  std::vector<DetachedBranch> detached;  ///< found by the search, if one was asked for
  int n_starts = 0;  ///< of the search: Newton iterations that looked for another solution
  long iterations = 0;
  long contact_evaluations = 0;
  long state_readings =
      0;                ///< of the step control: what the contact does at a place (step_states.hpp)
  long state_cuts = 0;  ///< steps it has cut
  double seconds = 0.0;
  /// Its highest peak with more harmonics, where they were chosen and the curve has fewer, or the
  /// choice was cut short.
  SettledPeak settled_peak;
};

}  // namespace microslip::solver
