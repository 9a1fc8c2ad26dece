/// @file
/// Which choices of the discretisation are refined so that the error of every peak becomes what was asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/scene/scene_description.hpp"

namespace microslip::pipelines {

/// A scene with finer settings.
struct Refinement {
  SceneDescription scene;
  std::string text;       ///< what is refined, for the log
  bool new_mesh = false;  ///< mesh and modes are solved for again
  double factor = 1.0;    ///< about, of the time that a round takes
};

/// The largest bar of all budgets, of amplitude or frequency; infinite where one has none, or there is none.
[[nodiscard]] double largest_bar(const std::vector<CurveBudget>& budgets);

/// Sources that one of the bars leaves out, named once.
[[nodiscard]] std::vector<std::string> not_in_bars(const std::vector<CurveBudget>& budgets);

/// Refines the source with the largest error until what is left should be within the tolerance: errors of cells fall
/// as their number grows, of the mesh with the square of its size, of fit and directions altogether, of harmonics to
/// the tolerance of their choice.
/// @return empty: the sources that matter cannot be refined any further; `left` names them.
[[nodiscard]] std::optional<Refinement> refinement(const SceneDescription& scene,
                                                   const std::vector<CurveBudget>& budgets,
                                                   double tolerance, std::string& left);

}  // namespace microslip::pipelines
