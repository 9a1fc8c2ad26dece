/// @file
/// Models that have what a scene leaves out: one effect more each, and all of them together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipelines/accuracy/richer_models.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Between the names of a source that is several effects.
inline constexpr std::string_view together = " + ";

/// The model at hand with one effect more each: normal motion that is left out, or the mean of it
/// alone, friction along r
/// where a scene forbids it though the patch moves along r, and what is "off" though other keys
/// give it: roughness (not without normal motion), dependence on speed, moments, the shape of a
/// static preload, axes of every place of a curved face; residual and rotation. Modes are solved
/// for again for the last three, but for axes that are left out of a face that is all but plane.
/// Several are put back together as well.
/// Harmonics and friction along r that was left to the program are in the error budget; friction
/// along r is here where there is none: of contact points that are given, in motions in time and in
/// linear limits.
/// @param structure  of the scene; nullptr: a kind that gives its modes itself.
/// @return `source` is the name of the effect, or all names with `together` between;
///         `no_bound` and `note` tell of those that cannot be had.
[[nodiscard]] RicherModels models_left_out(const ReducedModel& model, const SceneDescription& scene,
                                           const SolvedStructure* structure);

/// Effects that a scene leaves out though it could have them: what they would change is to be told.
[[nodiscard]] std::vector<std::string> effects_left_out(const ReducedModel& model,
                                                        const SceneDescription& scene);

/// Whether modes are solved for again with an effect that the scene leaves out.
[[nodiscard]] bool leaving_out_changes_modes(std::string_view name, const SceneDescription& scene);

}  // namespace microslip::pipelines
