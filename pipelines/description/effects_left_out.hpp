/// @file
/// The scene as simulated: what [effects] switches off though other keys give it is taken out of
/// the description, in this one place. What builds models, solves and writes sees a scene without.
///
/// The effects that are no part of a description, such as normal motion, are left out where models
/// are made (effects/effect_choice).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// What an effect that is switched off leaves behind.
struct EffectLeftOut {
  std::string_view effect;   ///< its key in [effects]
  std::string_view key;      ///< the other key, which gives it
  std::string_view instead;  ///< what is simulated in its place
};

/// Takes out every effect that is given and `"off"`; the scene as it was stays in `written`.
void leave_out_effects(SceneDescription& scene);

/// Takes out effects that are given and that `auto` leaves out, as if they were `"off"`, their
/// settings apart: of roughness and rate_dependence, and where they are not given nothing.
void leave_out_by_choice(SceneDescription& scene, const std::vector<std::string>& effects);

/// Those that are.
[[nodiscard]] std::vector<std::string> left_out_by_choice(const SceneDescription& scene);

/// Whether other keys give an effect that is `"off"`, or that `auto` leaves out; nullptr: it is
/// simulated, not given, or no part of a description.
[[nodiscard]] const EffectLeftOut* left_out(const SceneDescription& scene, std::string_view effect);

/// Whether other keys give an effect, and it is simulated.
[[nodiscard]] bool is_given(const SceneDescription& scene, std::string_view effect);

/// The scene as its keys give it, effects that are `"off"` as well.
[[nodiscard]] const SceneDescription& as_written(const SceneDescription& scene);

/// The same scene, other settings as they are, with an effect that is left out.
/// @throws std::invalid_argument  it is not left out.
[[nodiscard]] SceneDescription with_effect(const SceneDescription& scene, std::string_view effect);

/// The same scene without an effect that it has.
/// @throws std::invalid_argument  it is not given.
[[nodiscard]] SceneDescription without_effect(const SceneDescription& scene,
                                              std::string_view effect);

}  // namespace microslip::pipelines
