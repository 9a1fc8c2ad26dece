/// @file
/// How far a best preload can be trusted: what every choice of the discretisation does to the peaks
/// about it, and so to where the lowest of them lies.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/accuracy/richer_models.hpp"
#include "solver/optimum.hpp"

namespace microslip::pipelines {

/// The curves at the best preload p and at 0.84 p and 1.19 p are solved and their errors told
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
/// @return no rows: another number than the preload is searched, nothing is found, branches that no
///         sweep meets count about there, or time is over.
[[nodiscard]] CurveBudget optimum_budget(const ReducedModel& model, const SceneDescription& scene,
                                         const RicherModels& richer, const solver::Optimum& optimum,
                                         int jobs);

/// Of the other peak where two are equally high at the best value, one that falls with it and one
/// that rises [rad/s]. Empty: there is one alone.
[[nodiscard]] std::optional<double> frequency_of_crossing(const solver::Optimum& optimum);

/// Highest peaks of the curves at 0.84 p, p and 1.19 p [m].
using PeaksAboutBest = std::array<double, 3>;

/// The rows of the best value from those of the three curves. A source that one of them does not
/// tell has there the effect it has beside it, the larger one; which two do not tell is unknown.
/// @param jump  where two peaks cross: from one frequency to the other, relative.
[[nodiscard]] CurveBudget budget_about_best(const std::vector<CurveBudget>& budgets,
                                            const PeaksAboutBest& amplitudes,
                                            std::optional<double> jump = std::nullopt);

}  // namespace microslip::pipelines
