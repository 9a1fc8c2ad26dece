/// @file
/// How `auto` in [effects] is decided: one function for each row of effect_table.hpp, in its order.
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/curve_cost.hpp"
#include "pipelines/effects/effect_indicators.hpp"
#include "pipelines/effects/effect_record.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/text/effect_table.hpp"

namespace microslip::pipelines {

/// What is known when effects are chosen.
struct EffectFacts {
  const SceneDescription& scene;
  const ReducedModel* model;         ///< nullptr: not yet
  const mesh::Mesh* mesh = nullptr;  ///< nullptr: not known apart from the model
  std::optional<ContactReach> reach{};
  double motion_ratio = 0.0;     ///< motion_along_r.hpp; 0 without model
  bool both_directions = false;  ///< friction along r is simulated, as far as is known
  bool has_contact = false;
  bool has_friction = false;
  bool has_normal_stiffness = false;

  [[nodiscard]] std::string setting(std::string_view name) const { return setting_of(scene, name); }
  /// Indicators of the response can be told.
  [[nodiscard]] bool has_range() const { return model != nullptr && scene.response.has_value(); }
};

/// @param model, mesh  as of effects_of().
[[nodiscard]] EffectFacts effect_facts(const SceneDescription& scene, const ReducedModel* model,
                                       const mesh::Mesh* mesh = nullptr);

struct EffectDecision {
  Simulated simulated = Simulated::no;
  std::string reason;
  std::optional<double> indicator{};
  std::optional<double> threshold{};  ///< where it is not that of the table
  std::string refusal{};              ///< why the setting cannot be obeyed; empty: it is
  bool can_be = true;                 ///< false: nothing in the scene gives it, nothing is lost
};

/// Of one row. @throws std::out_of_range  no such effect.
[[nodiscard]] EffectDecision decide(const EffectRow& row, const EffectFacts& facts);

/// Whether anything that rubs can move along r, as far as is known.
[[nodiscard]] bool can_be_along_r(const EffectFacts& facts);

/// Motion along r over that along p that calls for friction there.
[[nodiscard]] double least_motion_along_r(const SceneDescription& scene);

[[nodiscard]] bool in_time(const SceneDescription& scene);

/// A solution is asked for, no curve. @param scene  with [response].
[[nodiscard]] bool is_single_frequency(const SceneDescription& scene);

/// A search for other solutions beside all curves of a scene, forecast [s].
[[nodiscard]] double seconds_of_search(const EffectFacts& facts);

/// Starts per frequency of a search that is made, asked for or not: twelve where that is short.
/// @param scene  with [response]. @param both_directions  friction is simulated along.
[[nodiscard]] int likely_starts(const SceneDescription& scene, bool both_directions);

/// Starts per frequency of that search, where the scene asks for one; 0: it does not.
[[nodiscard]] int asked_starts(const SceneDescription& scene);

/// Starts per frequency of the search for other solutions that a curve under a load gets; 0: none.
/// @throws RefusedError  no such load.
[[nodiscard]] int search_starts(const SceneDescription& scene, const ReducedModel& model,
                                double load);

/// What a scene has, as decided for a model of it. @param scene  with [response].
[[nodiscard]] CurveEffects decided_curve_effects(const SceneDescription& scene,
                                                 const ReducedModel& model);

/// What a scene says of its harmonics, in words.
[[nodiscard]] std::string harmonics_text(const SceneDescription& scene);

}  // namespace microslip::pipelines
