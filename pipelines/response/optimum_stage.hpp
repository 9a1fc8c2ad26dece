/// @file
/// The best value of one number of a scene: preload, friction coefficient, a thickness of the
/// blade, …; and what the contact data nobody knows well do to it.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"
#include "solver/optimum.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {

/// What a search has solved for at one value of its number.
struct SearchedScene {
  double value;
  double load;  ///< preload [N], or scale
  SceneDescription scene;
  ReducedModel model;
  std::shared_ptr<const SolvedStructure>
      structure;  ///< nullptr: a kind that gives its modes itself
};

class OptimumSearch {
 public:
  /// @param model      of the scene, borrowed.
  /// @param scene      with response.optimum, borrowed.
  /// @param structure  of the scene; nullptr: a kind that gives its modes itself.
  /// @param jobs       searches and checks side by side, ≥ 1; results do not depend on it.
  /// @throws SceneError  no bounds can be told.
  OptimumSearch(const ReducedModel& model, const SceneDescription& scene,
                std::shared_ptr<const SolvedStructure> structure, int jobs);

  /// What the search does otherwise than the curves, for the log; empty: nothing.
  [[nodiscard]] std::string warning() const;
  /// @throws SceneError, RefusedError  no scene, or none that can be simulated, at a value.
  [[nodiscard]] solver::Optimum best();
  /// A warning of what harmonics beyond those given do to what best() has found, and to its
  /// neighbours; empty: little, not checked, or nothing found.
  [[nodiscard]] std::string left_out(const solver::Optimum& optimum);
  /// The scene at a value. @throws SceneError, RefusedError  as best().
  [[nodiscard]] SearchedScene at(double value);
  /// Searched again with friction coefficient and local contact stiffness × 0.5 and × 2
  /// (contact_factors.hpp), as far as the contact has them as numbers and they are not what is
  /// searched. Friction moves the best preload: the range is widened by as much, and the entry says
  /// so. Of more than three harmonics with three: complete() adds what those are to be compared
  /// with.
  /// @param jobs  searches side by side; of another number than the preload one, whatever is asked
  ///              for. Of the preload it may run beside best().
  [[nodiscard]] OptimumBracket bracket(int jobs);
  /// Adds what few harmonics say of both as they are: that best() has begun with, or searched.
  void complete(OptimumBracket& bracket);
  /// Whether its searches have fewer harmonics than best(),
  /// which then takes longer than all of them.
  [[nodiscard]] bool bracket_by_few() const;

 private:
  struct Factors {
    double friction = 1.0;
    double stiffness = 1.0;
    int n_harmonics = 0;  ///< 0: as the scene has them
  };
  /// The bounds of the scene, or wider ones where the best value is known to move.
  [[nodiscard]] solver::OptimumOptions options_for(const Factors& factors) const;
  [[nodiscard]] solver::Optimum search(const Factors& factors, int jobs);
  [[nodiscard]] double load_at(double value, const ReducedModel& model) const;
  [[nodiscard]] solver::Scene scene_at(double value, const Factors& factors);
  [[nodiscard]] std::optional<solver::RicherPeak> richer_at(double value, int highest);
  [[nodiscard]] const ReducedModel& model_at(double value, double stiffness_factor);
  /// One task of the bracket.
  struct Change {
    const char* parameter;
    double factor;
    Factors factors;
  };
  [[nodiscard]] std::vector<Change> changes(OptimumBracket& bracket) const;

  const ReducedModel& model_;
  const SceneDescription& scene_;
  const OptimumRequest& request_;
  std::shared_ptr<const SolvedStructure> structure_;
  std::mutex family_mutex_;
  ModelFamily family_;
  int jobs_;
  solver::OptimumOptions options_;
  std::shared_ptr<const solver::Optimum> by_few_;  // of best()
};

}  // namespace microslip::pipelines
