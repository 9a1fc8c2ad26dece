#include "pipelines/files/write_csv.hpp"

#include <fmt/core.h>

#include <optional>

#include "pipelines/files/columns.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

void append_names(std::string& header, const std::string& stem, Eigen::Index n_modes) {
  for (Eigen::Index mode = 1; mode <= n_modes; ++mode) {
    header += fmt::format(",{}_{}", stem, mode);
  }
}

/// Row of a column, where it reaches so far.
std::optional<double> entry(const Eigen::VectorXd& column, Eigen::Index row) {
  return row < column.size() ? std::optional(column[row]) : std::nullopt;
}

}  // namespace

std::string curve_table(const solver::ResponseCurve& curve, const std::vector<PatchShares>& patches,
                        const std::optional<AmplitudeBand>& band) {
  std::string table = header_of(curve_columns());
  if (band) table.append(",").append(header_of(trust_columns()));
  for (const PatchShares& patch : patches) {
    for (const auto& column : patch_columns()) {
      table += fmt::format(",{}.{}", patch.patch, column.name);
    }
  }
  table += "\n";
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    table += row_of(curve_columns(), curve.points[i]);
    if (band) {
      table.append(",").append(row_of(trust_columns(), {band->low.at(i), band->high.at(i)}));
    }
    for (const PatchShares& patch : patches) {
      table.append(",").append(row_of(patch_columns(), patch.reports[i]));
    }
    table += "\n";
  }
  return table;
}

std::string states_table(const solver::ResponseCurve& curve, Eigen::Index n_modes) {
  const int n_harmonics = curve.points.empty() ? 1 : curve.points.front().q.n_harmonics();
  std::string table = curve_columns().front().name;
  append_names(table, mean_entry.name, n_modes);
  for (int h = 1; h <= n_harmonics; ++h) {
    append_names(table, sine_entry.name + std::to_string(h), n_modes);
    append_names(table, cosine_entry.name + std::to_string(h), n_modes);
  }
  table += "\n";
  for (const solver::ResponsePoint& point : curve.points) {
    table += format_number(in_hertz(point.frequency));
    for (const double value : point.q.vector()) table.append(",").append(format_number(value));
    table += "\n";
  }
  return table;
}

void write_curve(const std::filesystem::path& folder, const CurveResult& result,
                 Eigen::Index n_modes) {
  const std::filesystem::path curves = folder / "curves";
  make_folder(curves);
  write_whole(curves / (result.name + ".csv"),
              curve_table(result.curve, result.patch_shares, result.band));
  write_whole(curves / (result.name + ".states.csv"), states_table(result.curve, n_modes));
  int number = 0;
  for (const solver::DetachedBranch& branch : result.curve.detached) {
    solver::ResponseCurve alone;
    alone.points = branch.points;
    write_whole(curves / fmt::format("{}_detached_{}.csv", result.name, ++number),
                curve_table(alone));
  }
}

void write_modes_csv(const std::filesystem::path& file, const ModeTable& modes) {
  std::string table = header_of(mode_columns()) + "\n";
  const Eigen::Index n = modes.frequency.size();
  for (Eigen::Index mode = 0; mode < n; ++mode) {
    const ModeRow row{mode + 1,
                      modes.frequency[mode],
                      entry(modes.residual, mode),
                      entry(modes.damping_ratio, mode),
                      entry(modes.fit_error, mode),
                      mode >= n - modes.n_attachment};
    table += row_of(mode_columns(), row) + "\n";
  }
  write_whole(file, table);
}

void write_optimum_csv(const std::filesystem::path& folder, const OptimumRequest& request,
                       const solver::Optimum& optimum) {
  const auto columns = optimum_columns(request.of_preload());
  std::string table = header_of(columns) + "\n";
  for (const solver::PeakOfParameter& peak : optimum.trace) {
    table += row_of(columns, OptimumRow{optimum, peak}) + "\n";
  }
  write_whole(
      folder / (request.of_preload() ? "peak_against_preload.csv" : "peak_against_parameter.csv"),
      table);
}

}  // namespace microslip::pipelines
