/// @file
/// The command `cycle`: a table of contact points and motions → their steady friction cycles as JSON
/// (interfaces.md section 4).
#pragma once

#include <string>

#include "pipelines/csv_table.hpp"

namespace microslip::pipelines {

/// @return JSON array in input order.
/// @throws SceneError  missing, unknown or not yet available column, a value out of its range; with
///         line and column.
[[nodiscard]] std::string cycles_as_json(const CsvTable& table);

}  // namespace microslip::pipelines
