/// @file
/// Reduced models of one scene with one number changed: what the search for its best value goes
/// over; and the same with another local contact stiffness.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/structure/solved_structure.hpp"

namespace microslip::pipelines {

/// Modes, contact and preload at rest, effects not decided.
/// @param basis     of the structure, its own or a richer one.
/// @param warnings  sentences for the log are appended.
/// @throws SceneError, RefusedError  as reduce_to_contact(), set_static_preload().
[[nodiscard]] ReducedModel model_on_basis(const SceneDescription& scene,
                                          const SolvedStructure& structure,
                                          const fem::ModalBasis& basis,
                                          std::vector<std::string>& warnings);

/// The model the response stage solves, effects decided.
/// @param structure  of the scene; nullptr: a kind that gives its modes itself.
/// @param warnings   sentences for the log are appended.
/// @throws SceneError, RefusedError  as reduce_to_contact(), contact_effects().
[[nodiscard]] ReducedModel model_of(const SceneDescription& scene, const SolvedStructure* structure,
                                    std::vector<std::string>& warnings);

/// A richer, or leaner, model of the same scene.
/// @param structure  of the scene: its mesh serves, and its modes where the basis is the same.
///                   nullptr as above.
/// @param warnings   as above.
/// @throws std::invalid_argument  not one patch per contact,
///         or another basis where modes are given.
/// @throws SceneError, RefusedError  as model_of() and solve_structure().
[[nodiscard]] ReducedModel model_with(const Discretisation& settings, const SceneDescription& scene,
                                      const SolvedStructure* structure,
                                      std::vector<std::string>& warnings);

class ModelFamily {
 public:
  /// @param scene      borrowed.
  /// @param key        the number that changes, path as of --set.
  /// @param model      of the scene as it is: which effects are simulated stays as decided there.
  /// @param structure  of the scene; nullptr: a kind that gives its modes itself.
  ModelFamily(const SceneDescription& scene, std::string key, const ReducedModel& model,
              std::shared_ptr<const SolvedStructure> structure);

  /// The model at a value. Modes are solved anew only where the number changes them, and
  /// extrapolated as those of the scene are.
  /// @param stiffness_factor  of the local contact stiffness; other than 1 where the scene has it
  ///                          in keys (contact_factors.hpp) only.
  /// @throws SceneError, RefusedError  no scene, or none that can be simulated, at this value.
  [[nodiscard]] const ReducedModel& at(double value, double stiffness_factor = 1.0);
  /// The scene at a value. @throws SceneError  none.
  [[nodiscard]] SceneDescription scene_at(double value) const;
  /// Its mesh and modes; nullptr as above. @throws as at().
  [[nodiscard]] std::shared_ptr<const SolvedStructure> structure_at(double value);
  /// The model of the scene as it is but for its local contact stiffness.
  [[nodiscard]] const ReducedModel& as_given(double stiffness_factor);

 private:
  using Structure = std::shared_ptr<const SolvedStructure>;
  [[nodiscard]] Structure structure_at(double value, const SceneDescription& changed);
  [[nodiscard]] ReducedModel reduced(SceneDescription changed, double stiffness_factor,
                                     const SolvedStructure* structure) const;

  const SceneDescription& scene_;
  std::string key_;
  ContactEffects effects_;  ///< as chosen for the scene
  Structure structure_;
  std::map<double, Structure> structures_;                    // by value
  std::map<std::pair<double, double>, ReducedModel> models_;  // by value and factor
  std::map<double, ReducedModel> given_;                      // by factor
};

}  // namespace microslip::pipelines
