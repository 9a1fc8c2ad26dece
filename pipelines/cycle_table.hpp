/// @file
/// The command `cycle`: a table of contact points and motions → their steady friction cycles as JSON
/// (interfaces.md section 4).
///
/// A row with one harmonic is solved in closed form (friction_cycle.hpp) and carries its Jacobian; a row
/// with more is solved event by event (event_law.hpp), both exact. A row that moves along r as well is
/// solved by the planar law (planar_cycle.hpp), to 1e-12 of its force scale; the column
/// tangential_stiffness_r gives it another stiffness there.
#pragma once

#include <optional>
#include <string>

#include "pipelines/csv_table.hpp"
#include "pipelines/cycle_columns.hpp"

namespace microslip::pipelines {

/// @param n_harmonics  highest harmonic of the forces put out, 1 to largest_harmonic; nothing: the
///                     highest of the table.
/// @return JSON array in input order; numbers read back to the same doubles.
/// @throws SceneError  missing or unknown column, a value out of its range, a row
///         whose forces no double can hold; with line and column.
[[nodiscard]] std::string cycles_as_json(const CsvTable& table,
                                         std::optional<int> n_harmonics = std::nullopt);

}  // namespace microslip::pipelines
