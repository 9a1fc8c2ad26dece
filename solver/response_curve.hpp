/// @file
/// Solution points of a scene over frequency, in branch order, each with its proof: residual, energy
/// balance, stability.
#pragma once

#include <string>
#include <vector>

#include "contact/harmonics.hpp"
#include "contact/modal_force.hpp"

namespace microslip::solver {

using contact::Harmonics;

enum class PointMark { none, peak, fold };
/// 1, 0, −1 in files.
enum class Stability { unstable = 0, stable = 1, not_assessed = -1 };

struct ResponsePoint {
  double frequency = 0.0;  ///< ω [rad/s]
  Harmonics q;             ///< [m√kg]
  double amplitude = 0.0;          ///< half the peak-to-peak value of the output over the period [m]
  double first_amplitude = 0.0;    ///< first harmonic of the output [m]
  double mean = 0.0;               ///< mean of the output [m]
  double phase = 0.0;              ///< atan2(y_c, y_s) of the first harmonic [rad]
  double residual = 0.0;           ///< relative to max(excitation, contact force of the stuck limit)
  double energy_imbalance = 0.0;   ///< |W_exc − W_damp − W_fric| / max(|W_exc|, W_damp + W_fric)
  double dissipation_mismatch = 0.0;  ///< |W_fric − ∬∮ μn|ds| dA| over the same
  contact::CycleReport report;
  Stability stability = Stability::not_assessed;
  double determinant_sign = 0.0;   ///< of ∂R/∂q
  PointMark mark = PointMark::none;
  int iterations = 0;
};

struct ResponseCurve {
  std::vector<ResponsePoint> points;  ///< converged points only
  bool complete = false;
  std::string diagnosis;              ///< empty when complete; else newton-stall, no-start, …
  std::string message;                ///< a sentence with the numbers
  /// Empty, or what was proved instead of solved: the linear limit is a solution over the whole range.
  std::string certificate;
  long iterations = 0;
  long contact_evaluations = 0;
  double seconds = 0.0;
};

}  // namespace microslip::solver
