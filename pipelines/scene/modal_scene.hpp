/// @file
/// The [modal] section: modes and contact points from anywhere (interfaces.md, modal scenes).
#pragma once

#include <filesystem>

#include "pipelines/description/scene_description.hpp"
#include "pipelines/text/csv_table.hpp"
#include "pipelines/text/section_reader.hpp"

namespace microslip::pipelines {

/// @param section  the [modal] section.
/// @param folder   what a relative points file is relative to.
/// @throws SceneError  lengths that do not fit, a bad value, a bad points table.
[[nodiscard]] ModalModel read_modal(SectionReader section, const std::filesystem::path& folder);

/// Fills weights, points, shapes and positions of the model from a table.
/// @throws SceneError  missing or unknown column, negative stiffness, … with line and column.
void set_points(ModalModel& model, const CsvTable& table, Eigen::Index n_modes);

}  // namespace microslip::pipelines
