/// @file
/// Columns and arrays of curves, modes, maps, models and cycles, once: name, unit, meaning and
/// where the value comes from. CSV, HDF5 and VTK files are written from these tables and
/// share/doc/columns.md is printed from them: a new column is one row in columns.cpp. Pictures of a
/// whole mesh (write_vtk.hpp, write_faces.hpp) carry names of the scene instead.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "contact/contact_map.hpp"
#include "contact/modal_force.hpp"
#include "contact/patch.hpp"
#include "contact/point_cycle.hpp"
#include "pipelines/accuracy/convergence.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/structure/campbell.hpp"
#include "solver/optimum.hpp"
#include "solver/response_curve.hpp"

namespace microslip::pipelines {

/// One column of a CSV file: `text` is what a row has in it.
template <typename Row>
struct Column {
  const char* name;
  const char* unit;
  const char* doc;
  std::string (*text)(const Row&);
};

/// curves/NAME.csv, a row per solution point.
[[nodiscard]] std::span<const Column<solver::ResponsePoint>> curve_columns();

/// Further columns of curves/NAME.csv for each of several patches: PATCH.NAME.
[[nodiscard]] std::span<const Column<contact::CycleReport>> patch_columns();

/// Further columns of curves/NAME.csv where the error of the curve is told.
struct TrustedAmplitude {
  double low = 0.0;   ///< [m]
  double high = 0.0;  ///< [m]
};
[[nodiscard]] std::span<const Column<TrustedAmplitude>> trust_columns();

/// history.csv, a row per point as it is finished; the first three tell points apart.
struct HistoryRow {
  const std::string& curve;
  const solver::ResponsePoint& point;
  double seconds = 0.0;
};
[[nodiscard]] std::span<const Column<HistoryRow>> history_columns();

/// converge/KNOB.csv, a row per rung and curve.
[[nodiscard]] std::span<const Column<RungResult>> ladder_columns();

/// modes.csv, a row per mode.
struct ModeRow {
  Eigen::Index mode = 1;
  double frequency = 0.0;  ///< ω [rad/s]
  std::optional<double> residual, damping_ratio, fit_error;
  bool is_attachment = false;
};
[[nodiscard]] std::span<const Column<ModeRow>> mode_columns();

/// campbell/frequencies.csv, a row per speed and mode.
struct CampbellRow {
  double speed = 0.0;  ///< Ω [rad/s]
  Eigen::Index mode = 0;
  double frequency = 0.0;  ///< ω [rad/s]
};
[[nodiscard]] std::span<const Column<CampbellRow>> campbell_columns();

/// campbell/crossings.csv, a row per crossing.
[[nodiscard]] std::span<const Column<Crossing>> crossing_columns();

/// peak_against_preload.csv and peak_against_parameter.csv, a row per value tried.
struct OptimumRow {
  const solver::Optimum& optimum;
  const solver::PeakOfParameter& peak;
};
/// @param of_preload  else the first column is `value`.
[[nodiscard]] std::span<const Column<OptimumRow>> optimum_columns(bool of_preload);

/// DIR/ID.csv of `cycle --plot`, a row per instant.
struct CycleInstant {
  double phase = 0.0;  ///< [rad], from 0 to 2π
  const contact::PointInstant& at;
  std::string_view state;  ///< its name, from this instant on
};
[[nodiscard]] std::span<const Column<CycleInstant>> cycle_columns();

/// `at` of a best value: peak, range_end (of the frequency range) or unsolved.
[[nodiscard]] const char* to_string(solver::PeakPlace place);

/// One array of contact maps, in .vtp and in .h5. Left out where it has no elements.
template <typename Values>
struct MapArray {
  const char* name;
  const char* unit;
  const char* doc;
  Values contact::ContactMap::*values;
};

/// Fields at one phase, n × n_phases.
[[nodiscard]] std::span<const MapArray<Eigen::MatrixXd>> instant_arrays();
/// Fields of the whole period, n.
[[nodiscard]] std::span<const MapArray<Eigen::VectorXd>> cycle_arrays();

/// Of each of the five states, in .vtp: STATE_NAME.
template <typename Values>
struct StateArray {
  const char* name;
  const char* unit;
  const char* doc;
  Values (*get)(const contact::ContactMap&, Eigen::Index state);
};
[[nodiscard]] std::span<const StateArray<Eigen::VectorXd>> state_arrays();
[[nodiscard]] std::span<const StateArray<Eigen::VectorXi>> state_counts();
/// Their names there, in the order of ContactState.
[[nodiscard]] std::span<const char* const> state_stems();

/// One dataset of an .h5 file and what it is taken from.
template <typename Source, typename Values>
struct Dataset {
  const char* name;
  const char* unit;
  const char* doc;
  Values (*get)(const Source&);
};
using Indices = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;

/// maps/NAME.h5: of the whole map; of the points, with `vertex_` in front of the vertices;
/// where they are.
[[nodiscard]] std::span<const Dataset<NamedMap, Eigen::VectorXd>> map_arrays();
[[nodiscard]] std::span<const Dataset<contact::ContactMap, Eigen::MatrixXd>> transition_arrays();
[[nodiscard]] std::span<const Dataset<contact::Patch, Eigen::MatrixXd>> map_places();

/// model.h5: modes, excitation, output; each patch, in /contact/.
[[nodiscard]] std::span<const Dataset<ReducedModel, Eigen::VectorXd>> model_arrays();
[[nodiscard]] std::span<const Dataset<contact::Patch, Eigen::MatrixXd>> patch_places();
[[nodiscard]] std::span<const Dataset<contact::Patch, Eigen::VectorXd>> fit_arrays();
/// Over the places of a patch: /contact/NAME at its points,
/// /contact/vertex_NAME at the vertices of its cells.
[[nodiscard]] std::span<const Dataset<contact::PatchSamples, Eigen::VectorXd>> sample_arrays();
[[nodiscard]] std::span<const Dataset<contact::PatchSamples, Eigen::MatrixXd>> shape_arrays();

/// Of both files: areas of the points, and vertices of their cells.
[[nodiscard]] std::span<const Dataset<contact::Patch, Eigen::VectorXd>> weight_arrays();
[[nodiscard]] std::span<const Dataset<contact::Patch, Indices>> cell_arrays();

/// What is written in a form of its own.
struct Entry {
  const char* name;
  const char* unit;
  const char* doc;
};
/// At each phase, a number of ContactState.
inline constexpr Entry state_entry{
    "state", "1",
    "0 stick, 1 positive slip, 2 negative slip, 3 separated, 4 slip in two directions"};
/// curves/NAME.states.csv: the frequency, then these of every mode from 1 (`_1`, `_2`, …), sine and
/// cosine of every harmonic.
inline constexpr Entry mean_entry{"q_mean", "m kg^0.5", "mean of a modal coordinate"};
inline constexpr Entry sine_entry{"q_sin", "m kg^0.5", "its sine, harmonic K"};
inline constexpr Entry cosine_entry{"q_cos", "m kg^0.5", "its cosine, harmonic K"};

/// Positions of the contact points [m]; a row along p where the model has none.
[[nodiscard]] Eigen::MatrixX3d point_positions(const contact::Patch& patch);

/// All of them as Markdown: share/doc/columns.md, `microslip columns`.
[[nodiscard]] std::string columns_text();

/// Names of all columns, separated by commas.
template <typename Row>
[[nodiscard]] std::string header_of(std::span<const Column<Row>> columns) {
  std::string header;
  for (const Column<Row>& column : columns)
    header.append(header.empty() ? "" : ",").append(column.name);
  return header;
}

/// One row, without its end of line.
template <typename Row>
[[nodiscard]] std::string row_of(std::span<const Column<Row>> columns, const Row& row) {
  std::string text;
  const char* separator = "";
  for (const Column<Row>& column : columns) {
    text.append(separator).append(column.text(row));
    separator = ",";
  }
  return text;
}

}  // namespace microslip::pipelines
