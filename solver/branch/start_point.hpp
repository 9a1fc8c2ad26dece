/// @file
/// A first solution at one frequency: Newton from a motion near by, from the linear limits, then
/// homotopies that exchange a linear limit for the contact.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "solver/balance/newton.hpp"

namespace microslip::solver {

struct StartPoint {
  std::optional<NewtonResult> solution;
  std::string way;          ///< how it was reached, or what was tried
  bool is_stopped = false;  ///< before all was tried
  long iterations = 0;
  long evaluations = 0;
};

/// @param tolerance  of ResponsePoint::residual.
/// @param near       a motion near the solution, tried first; nullptr: none is known.
/// @param stop       asked after the first attempt, between others and between steps of a homotopy,
///                   which may be a thousand; empty: never true.
[[nodiscard]] StartPoint find_start(HarmonicBalance& balance, double frequency, double tolerance,
                                    const Harmonics* near = nullptr,
                                    const std::function<bool()>& stop = {});

/// Newton at a fixed frequency from a guess, on the scale of the balance there.
[[nodiscard]] NewtonResult solve_at(HarmonicBalance& balance, const Eigen::VectorXd& guess,
                                    double frequency, const NewtonOptions& options);

/// Scale of unknowns: ‖x‖, or the linear responses' where x vanishes; of residuals: force_scale.
[[nodiscard]] Scaling natural_scaling(const HarmonicBalance& balance, const Eigen::VectorXd& x,
                                      double frequency);

}  // namespace microslip::solver
