#include "pipelines/files/write_csv.hpp"

#include <fmt/core.h>

#include <initializer_list>
#include <numbers>

#include "pipelines/system/output_file.hpp"

namespace microslip::pipelines {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double degrees = 180.0 / std::numbers::pi;

const char* mark_name(solver::PointMark mark) {
  switch (mark) {
    case solver::PointMark::peak:
      return "peak";
    case solver::PointMark::fold:
      return "fold";
    case solver::PointMark::none:
      break;
  }
  return "";
}

void append_row(std::string& table, std::initializer_list<double> numbers) {
  const char* separator = "";
  for (const double number : numbers) {
    table += separator;
    table += format_number(number);
    separator = ",";
  }
}

void append_names(std::string& header, const std::string& stem, Eigen::Index n_modes) {
  for (Eigen::Index mode = 1; mode <= n_modes; ++mode) {
    header += fmt::format(",{}_{}", stem, mode);
  }
}

std::string cell(const Eigen::VectorXd& column, Eigen::Index row) {
  return row < column.size() ? format_number(column[row]) : std::string();
}

}  // namespace

std::string curve_table(const solver::ResponseCurve& curve) {
  std::string table =
      "frequency_Hz,amplitude_m,amplitude_1_m,mean_m,phase_deg,stable,stick_share,slip_share,"
      "separated_share,three_states_share,residual,energy_imbalance,dissipation_mismatch,mark,"
      "awake_share,iterations,harmonics\n";
  for (const solver::ResponsePoint& point : curve.points) {
    append_row(table, {point.frequency / two_pi, point.amplitude, point.first_amplitude, point.mean,
                       point.phase * degrees});
    table += fmt::format(",{},", static_cast<int>(point.stability));
    append_row(table, {point.report.stick_share, point.report.slip_share,
                       point.report.separated_share, point.report.three_states_share,
                       point.residual, point.energy_imbalance, point.dissipation_mismatch});
    table += ",";
    table += mark_name(point.mark);
    const std::size_t harmonics =
        point.orders.empty() ? static_cast<std::size_t>(point.q.n_harmonics()) : point.orders.size();
    table += fmt::format(",{},{},{}\n", format_number(point.report.awake_share), point.iterations,
                         harmonics);
  }
  return table;
}

std::string states_table(const solver::ResponseCurve& curve, Eigen::Index n_modes) {
  const int n_harmonics = curve.points.empty() ? 1 : curve.points.front().q.n_harmonics();
  std::string table = "frequency_Hz";
  append_names(table, "q_mean", n_modes);
  for (int h = 1; h <= n_harmonics; ++h) {
    append_names(table, "q_sin" + std::to_string(h), n_modes);
    append_names(table, "q_cos" + std::to_string(h), n_modes);
  }
  table += "\n";
  for (const solver::ResponsePoint& point : curve.points) {
    table += format_number(point.frequency / two_pi);
    for (const double value : point.q.vector()) table.append(",").append(format_number(value));
    table += "\n";
  }
  return table;
}

void write_curve(const std::filesystem::path& folder, const CurveResult& result,
                 Eigen::Index n_modes) {
  const std::filesystem::path curves = folder / "curves";
  make_folder(curves);
  write_whole(curves / (result.name + ".csv"), curve_table(result.curve));
  write_whole(curves / (result.name + ".states.csv"), states_table(result.curve, n_modes));
  int number = 0;
  for (const solver::DetachedBranch& branch : result.curve.detached) {
    solver::ResponseCurve alone;
    alone.points = branch.points;
    write_whole(curves / fmt::format("{}_detached_{}.csv", result.name, ++number), curve_table(alone));
  }
}

void write_modes_csv(const std::filesystem::path& file, const ModeTable& modes) {
  std::string table = "mode,frequency_Hz,residual,damping_ratio,fit_error,kind\n";
  const Eigen::Index n = modes.frequency.size();
  for (Eigen::Index mode = 0; mode < n; ++mode) {
    table +=
        fmt::format("{},{},{},{},{},{}\n", mode + 1, format_number(modes.frequency[mode] / two_pi),
                    cell(modes.residual, mode), cell(modes.damping_ratio, mode),
                    cell(modes.fit_error, mode), mode < n - modes.n_attachment ? "free" : "attachment");
  }
  write_whole(file, table);
}

const char* to_string(solver::PeakPlace place) {
  switch (place) {
    case solver::PeakPlace::peak: return "peak";
    case solver::PeakPlace::range_end: return "range_end";
    case solver::PeakPlace::unsolved: break;
  }
  return "unsolved";
}

void write_optimum_csv(const std::filesystem::path& folder, const OptimumRequest& request,
                       const solver::Optimum& optimum) {
  std::string table = request.of_preload() ? "preload_N" : "value";
  table += ",frequency_Hz,amplitude_m,at,mark\n";
  for (const solver::PeakOfParameter& peak : optimum.trace) {
    append_row(table, {peak.parameter, peak.frequency / two_pi, peak.amplitude});
    const bool best = optimum.found && peak.parameter == optimum.best.parameter;
    const bool flat = optimum.flat && peak.parameter >= (*optimum.flat)[0] &&
                      peak.parameter <= (*optimum.flat)[1];
    table += fmt::format(",{},{}\n", to_string(peak.place), best ? "optimum" : flat ? "flat" : "");
  }
  write_whole(folder / (request.of_preload() ? "peak_against_preload.csv" : "peak_against_parameter.csv"),
              table);
}

}  // namespace microslip::pipelines
