/// @file
/// The command `cycle`: a table of contact points and motions → their steady friction cycles as JSON
/// (interfaces.md section 4).
#pragma once

#include <string>

#include "pipelines/csv_table.hpp"

namespace microslip::pipelines {

inline constexpr int largest_harmonic = 1000;

/// @param n_harmonics  highest harmonic of the forces put out, 1 to largest_harmonic.
/// @return JSON array in input order; numbers read back to the same doubles.
/// @throws SceneError  missing, unknown or not yet available column, a value out of its range, a row
///         whose forces no double can hold; with line and column.
[[nodiscard]] std::string cycles_as_json(const CsvTable& table, int n_harmonics = 1);

}  // namespace microslip::pipelines
