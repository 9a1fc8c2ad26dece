/// @file
/// [effects]: which of them a scene switches, and settings that contradict the rest of it or each
/// other.
#pragma once

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// Sets SceneDescription::effects, in the order of the table, and the choice of directions.
/// @param given  the whole scene, for messages.
/// @param scene  read but for its effects.
/// @throws SceneError  a setting that contradicts another key; the message names both, and where
///                     the other one stands.
void read_effects(const SectionReader& s, const toml::table& given, SceneDescription& scene);

}  // namespace microslip::pipelines
