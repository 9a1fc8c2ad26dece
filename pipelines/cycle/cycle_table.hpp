/// @file
/// The command `cycle`: a table of contact points and motions → their steady friction cycles as
/// JSON (interfaces.md section 4).
///
/// Which method serves a row is said in cycle_row.hpp; a row with one harmonic carries its
/// Jacobian, and the column tangential_stiffness_r gives a row that moves along r another stiffness
/// there.
#pragma once

#include <optional>
#include <string>

#include "pipelines/cycle/cycle_columns.hpp"
#include "pipelines/text/csv_table.hpp"

namespace microslip::pipelines {

/// @param n_harmonics  highest harmonic of the forces put out, 1 to largest_harmonic; nothing: the
///                     highest of the table.
/// @return JSON array in input order; numbers read back to the same doubles.
/// @throws SceneError  missing or unknown column, a value out of its range, a row
///         whose forces no double can hold; with line and column.
[[nodiscard]] std::string cycles_as_json(const CsvTable& table,
                                         std::optional<int> n_harmonics = std::nullopt);

}  // namespace microslip::pipelines
