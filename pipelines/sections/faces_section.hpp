/// @file
/// The [faces] section: names for the faces of a STEP file.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "pipelines/description/scene_description.hpp"

namespace microslip::pipelines {

/// Every entry of [faces]: a table, or a list of tables.
/// @param complete  receives what was read.
/// @throws SceneError  with file, line and key: not one of point, normal and number.
[[nodiscard]] std::vector<FaceDescription> read_faces(const toml::table& table,
                                                      const std::string& file,
                                                      toml::table& complete);

}  // namespace microslip::pipelines
