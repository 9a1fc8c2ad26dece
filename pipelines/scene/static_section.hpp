/// @file
/// The [static] section: the steady rotation of a structure with a mesh.
#pragma once

#include <optional>
#include <string>

#include "fem/rotation.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// Nothing without an axis; speed 0 where there is only an axis.
/// @throws SceneError  a speed without an axis, a speed below 0, an axis without direction; with file, line and key.
[[nodiscard]] std::optional<fem::Rotation> read_rotation(SectionReader s);

/// [rad/s] of "3000 rpm", "314 rad/s", "50 Hz" (turns per second); a number alone is in rad/s.
/// @throws UnitError  no such number or unit, or below 0.
[[nodiscard]] double rotation_speed(const std::string& text);

}  // namespace microslip::pipelines
