/// @file
/// How far the numbers of a curve can be trusted: what every choice of the discretisation does to
/// its highest peak, each told by a model that has it richer, solved from the peak of the curve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/richer_models.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/response/run_results.hpp"
#include "solver/point_shift.hpp"

namespace microslip::pipelines {

struct CurveBudget {
  std::vector<ErrorRow> rows;
  std::vector<std::string> unknown;  ///< sources that could not be told: the bar leaves them out
  std::vector<ErrorRow> left_out{};  ///< effects of physics (left_out.hpp): no part of the bar
  std::vector<NoBound> no_bound{};   ///< of those that have no row there
  bool touches = true;               ///< the contact has a part in the highest peak
  double dissipated_energy = 0.0;    ///< by friction in a period at the highest peak [J]
  /// Energy that a period takes there over what friction takes of it: a relative change of the
  /// amplitude changes the dissipated energy by no more than so much of it, as work of the
  /// excitation grows with the amplitude and that of damping with its square. Empty: friction
  /// dissipates nothing, and the goal has no rows.
  std::optional<double> energy_ratio{};
  /// Of the harmonics left out, all along the curve (harmonics_along()); empty: not told.
  std::vector<solver::PointShift> along{};
  /// Whether the rows bound the error: not where more harmonics give another curve,
  /// which outweighs all others.
  [[nodiscard]] bool has_bar() const;
};

/// @param result  a curve of the model, or a linear limit: modes that are given leave that without
///                rows. Of motions integrated in time the steps and the frequencies between have
///                rows (errors_in_time.hpp), the discretisation of the body none.
[[nodiscard]] CurveBudget error_budget(const ReducedModel& model, const SceneDescription& scene,
                                       const RicherModels& richer, const CurveResult& result);

/// What harmonics beyond its own move a curve by, all along (solver/point_shift.hpp).
/// @return sizes, one for each point; empty of a linear limit, and where nothing could be told.
[[nodiscard]] std::vector<solver::PointShift> harmonics_along(ReducedModel model,
                                                              const SceneDescription& scene,
                                                              const CurveResult& result);

/// Errors of a curve that got other harmonics alone, where there is no time to tell the others
/// again: those of the curve before, but for the harmonics.
/// @param now  has them, and what friction dissipates.
[[nodiscard]] CurveBudget with_harmonics_of(CurveBudget before, const CurveBudget& now);

/// Sources that one curve could not be followed with, or had no time for, and others could: the
/// largest effect of those stands in for its own. Curves without contact stand in for the mesh
/// alone.
void borrow_unknown(std::vector<CurveBudget>& budgets);

/// One line: the bar and its largest parts. Empty without rows.
[[nodiscard]] std::string budget_text(const CurveBudget& budget);

}  // namespace microslip::pipelines
