/// @file
/// How far a best value can be trusted: what every choice of the discretisation does to the peaks
/// about it, and so to where the lowest of them lies.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/accuracy/richer_models.hpp"
#include "solver/optimum.hpp"

namespace microslip::pipelines {

/// A scene at the best value of its number, or beside it.
struct SceneAtValue {
  double value;  ///< of the number that is searched
  double load;   ///< preload [N], or scale
  const SceneDescription* scene;
  const ReducedModel* model;
  const RicherModels* richer;
};

/// Below the best value, there, above it.
using ScenesAboutBest = std::array<SceneAtValue, 3>;
using ValuesAboutBest = std::array<double, 3>;

/// Of a value p where curves are solved: 0.84 p, p and 1.19 p, inside the range of the search where
/// it is of another number than the preload. @param range  [low, high]; empty: no bounds.
/// @return empty: p is not positive, or an end of the range, and has no two sides.
[[nodiscard]] std::optional<ValuesAboutBest> values_about(
    double best, const std::optional<std::array<double, 2>>& range = std::nullopt);

/// The curves at the best value p and on both sides of it are solved and their errors told
/// (error_budget.hpp). With a source refined the peaks are A (1 + e); their lowest point moves by
///
///   log(p'/p) = (log(1 + e₋) − log(1 + e₊)) / (s₊ − s₋),     s = Δlog A / Δlog p to its
///                                                            neighbours,
///
/// exact where two peaks cross at p, twice as far as it goes where one has a minimum there; at most
/// to the neighbours. The lowest amplitude becomes that of the lowest of the three peaks A (1 + e).
/// Where two peaks cross at p it becomes that of the crossing, log(A'/A) = (s₊ log(1 + e₋) −
/// s₋ log(1 + e₊)) / (s₊ − s₋), if that is more, and its frequency may be that of the other peak:
/// a row of the source `continuation`.
/// Relative effects, goals optimum, peak_amplitude, peak_frequency and, where
/// friction dissipates there, dissipated_energy.
/// @param jobs  curves side by side, ≥ 1.
/// @return no rows: nothing is found, branches that no sweep meets count about there, or time is
///         over.
[[nodiscard]] CurveBudget optimum_budget(const ScenesAboutBest& about,
                                         const solver::Optimum& optimum, int jobs);

/// The same of a best preload, for which one model stands.
[[nodiscard]] CurveBudget optimum_budget(const ReducedModel& model, const SceneDescription& scene,
                                         const RicherModels& richer, const solver::Optimum& optimum,
                                         int jobs);

/// Of the other peak where two are equally high at the best value, one that falls with it and one
/// that rises [rad/s]. Empty: there is one alone.
[[nodiscard]] std::optional<double> frequency_of_crossing(const solver::Optimum& optimum);

/// Highest peaks of the three curves [m].
using PeaksAboutBest = std::array<double, 3>;

/// The rows of the best value from those of the three curves. A source that one of them does not
/// tell has there the effect it has beside it, the larger one; which two do not tell is unknown.
/// @param values  of the number that is searched.
/// @param jump    where two peaks cross: from one frequency to the other, relative.
[[nodiscard]] CurveBudget budget_about_best(const std::vector<CurveBudget>& budgets,
                                            const ValuesAboutBest& values,
                                            const PeaksAboutBest& amplitudes,
                                            std::optional<double> jump = std::nullopt);

}  // namespace microslip::pipelines
