/// @file
/// The [points] section, and the places of a mesh that other sections name:
/// `at` of a force or of the output.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// Every entry of [points]: three coordinates, or a name of the mesh.
/// @param complete  receives what was read.
/// @throws SceneError  with file, line and key.
[[nodiscard]] std::vector<PointDescription> read_points(const toml::table& table,
                                                        const std::string& file,
                                                        toml::table& complete);

/// Coordinates [x, y, z] of a key [m]. @throws SceneError  it is no such list.
[[nodiscard]] Eigen::Vector3d coordinates_in(const SectionReader& s, std::string_view key);

/// The name to look for in the mesh: that of an entry of [points] that is another name of a set is
/// the set's.
[[nodiscard]] std::string name_in_mesh(const std::vector<PointDescription>& points,
                                       std::string name);

/// What `at` stands for, as name_in_mesh(). Coordinates become a point of their own.
/// @throws SceneError  neither a name nor three coordinates.
[[nodiscard]] std::string read_place(const SectionReader& s, std::string_view key,
                                     std::vector<PointDescription>& points);

}  // namespace microslip::pipelines
