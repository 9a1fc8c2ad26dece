/// @file
/// The best value of one number of a scene: preload, friction coefficient, a thickness of the blade, …;
/// and what the contact data nobody knows well do to it.
#pragma once

#include <memory>
#include <vector>

#include "pipelines/model_family.hpp"
#include "pipelines/run_results.hpp"
#include "pipelines/scene_description.hpp"
#include "solver/peak.hpp"

namespace microslip::pipelines {

class OptimumSearch {
 public:
  /// @param model      of the scene, borrowed.
  /// @param scene      with response.optimum, borrowed.
  /// @param structure  of the scene; nullptr: a kind that gives its modes itself.
  /// @throws SceneError  no bounds can be told.
  OptimumSearch(const ReducedModel& model, const SceneDescription& scene,
                std::shared_ptr<const SolvedStructure> structure);

  /// @throws SceneError, RefusedError  no scene, or none that can be simulated, at a value.
  [[nodiscard]] solver::Optimum best();
  /// Searched again with friction coefficient and contact stiffness × 0.5 and × 2, as far as the contact
  /// has them as numbers and they are not what is searched.
  [[nodiscard]] std::vector<OptimumOfFactor> bracket();

 private:
  using Change = std::function<ReducedModel(ReducedModel)>;
  [[nodiscard]] solver::Optimum search(const Change& change, const solver::OptimumOptions& options);

  const ReducedModel& model_;
  const SceneDescription& scene_;
  const OptimumRequest& request_;
  ModelFamily family_;
  solver::OptimumOptions options_;
};

}  // namespace microslip::pipelines
