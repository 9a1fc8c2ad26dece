/// @file
/// Every column and array the program writes, once: name, unit, meaning and where its value comes from. CSV, HDF5 and
/// VTK files are written from these tables and share/doc/columns.md is printed from them: a new column is one
/// row in columns.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <Eigen/Core>

#include "contact/contact_map.hpp"
#include "contact/modal_force.hpp"
#include "contact/patch.hpp"
#include "pipelines/accuracy/convergence.hpp"
#include "pipelines/model/campbell.hpp"
#include "solver/peak.hpp"
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
  double amplitude = 0.0;  ///< [m]
  double bar = 0.0;        ///< relative half width
};
[[nodiscard]] std::span<const Column<TrustedAmplitude>> trust_columns();

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

/// `at` of an optimum: peak, range_end (of the frequency range) or unsolved.
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

/// Arrays of model.h5 over the places of a patch: /contact/NAME at its points, /contact/vertex_NAME at the vertices
/// of its cells.
struct SampleArray {
  const char* name;
  const char* unit;
  const char* doc;
  Eigen::VectorXd (*get)(const contact::PatchSamples&);
};
[[nodiscard]] std::span<const SampleArray> sample_arrays();

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
