/// @file
/// A scene with certain settings, solved as far as its curves.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pipelines/accuracy/effect_bounds.hpp"
#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

using StructurePointer = std::shared_ptr<const SolvedStructure>;

struct Solution {
  SceneDescription scene;
  StructurePointer structure;  ///< nullptr: a kind that gives its modes itself
  ReducedModel model{};
  std::vector<CurveResult> curves{};
  std::vector<CurveBudget> budgets{};       ///< one per curve; none where they are not asked for
  std::vector<MissedEffect> switched_on{};  ///< left out at first; simulated here

  /// Of the mesh; 0 without one.
  [[nodiscard]] double degrees_of_freedom() const {
    return structure ? 3.0 * static_cast<double>(structure->mesh.n_nodes()) : 0.0;
  }
};

}  // namespace microslip::pipelines
