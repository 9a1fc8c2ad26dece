/// @file
/// The [static] section: steady rotation and loads that do not vary, of a structure with a mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/rotation.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// Nothing without an axis; speed 0 where there is only an axis.
/// @throws SceneError  a speed without an axis, a speed below 0, an axis without direction;
///         with file, line and key.
[[nodiscard]] std::optional<fem::Rotation> read_rotation(SectionReader s);

/// Forces and pressures. @param points  receives places given by coordinates.
/// @throws SceneError  no list, an entry with a key missing or unknown; with file, line and key.
[[nodiscard]] StaticLoads read_static_loads(SectionReader s, std::vector<PointDescription>& points);

/// Whether contact.preload = "static", the loads, the supports and the response fit together.
/// @throws SceneError  static loads that nothing uses; a static preload of some contacts alone,
///         without loads, without supports, or in modes of another code;
///         response.preload = "static" without one.
void require_static_preload(const SceneDescription& scene);

/// [rad/s] of "3000 rpm", "314 rad/s", "50 Hz" (turns per second); a number alone is in rad/s.
/// @throws UnitError  no such number or unit, or below 0.
[[nodiscard]] double rotation_speed(const std::string& text);

}  // namespace microslip::pipelines
