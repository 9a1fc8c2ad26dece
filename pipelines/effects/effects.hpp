/// @file
/// Which physical effects a scene is simulated with, and why:
/// one record per row of effect_table.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/effects/effect_record.hpp"
#include "pipelines/effects/model_family.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Chooses what `auto` leaves open, by the indicators.
/// @param model  with its patches; nullptr: not known yet,
///               so that what depends on modes is undecided.
/// @param mesh   of a scene whose model is not known, if it is read.
[[nodiscard]] std::vector<EffectRecord> effects_of(const SceneDescription& scene,
                                                   const ReducedModel* model,
                                                   const mesh::Mesh* mesh = nullptr);

/// The indicator of moments that a scene of a mesh leaves out, by its model with them.
/// @param structure  of the scene.   @param effects  as of effects_of().
void tell_moments_left_out(const SceneDescription& scene, const SolvedStructure& structure,
                           std::vector<EffectRecord>& effects);

/// The same of what stands for omitted modes: modes are solved for again.
void tell_residual_left_out(const SceneDescription& scene, const SolvedStructure& structure,
                            std::vector<EffectRecord>& effects);

/// One of them. @throws std::out_of_range  no such name.
[[nodiscard]] const EffectRecord& effect_in(const std::vector<EffectRecord>& effects,
                                            std::string_view name);

/// The table as `check` prints it and a log keeps it, a line each, under a heading.
[[nodiscard]] std::vector<std::string> effect_lines(const std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
