/// @file
/// [effects]: which of them a scene switches, and settings that contradict the rest of it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipelines/scene/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// name → auto | on | off, in the order of the keys.
/// @param scene  read but for its effects.
/// @throws SceneError  a setting that another section contradicts.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> read_effects(
    const SectionReader& s, const SceneDescription& scene);

[[nodiscard]] Discretisation::Choice read_second_direction(const SectionReader& s);

}  // namespace microslip::pipelines
