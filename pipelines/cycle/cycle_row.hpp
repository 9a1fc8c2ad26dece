/// @file
/// One row of a table of contact points solved (contact/point_cycle.hpp chooses how), so that every
/// output of the command `cycle` shows the same cycle.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "contact/point_cycle.hpp"
#include "pipelines/cycle/cycle_columns.hpp"
#include "pipelines/text/csv_table.hpp"

namespace microslip::pipelines {

struct CycleRow {
  std::string id;  ///< of the table, else the number of the row from 1
  contact::PointHistory history;
  std::optional<contact::CycleJacobian> jacobian;  ///< single-harmonic motion only
};

/// @param n_harmonics  of the force, ≥ 1.
/// @param phases       of the instants wanted [rad], any.
/// @throws SceneError  a constant out of its range, an id that is no UTF-8, forces that no double
///         can hold; with line.
[[nodiscard]] CycleRow solve_row(const CsvTable& table, const CycleColumns& columns,
                                 std::size_t row, int n_harmonics,
                                 const Eigen::VectorXd& phases = {});

/// As in JSON and CSV: "stick", "positive_slip", "negative_slip", "slip", "separated".
[[nodiscard]] const char* state_name(contact::ContactState state);

}  // namespace microslip::pipelines
