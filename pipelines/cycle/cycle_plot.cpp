#include "pipelines/cycle/cycle_plot.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "contact/phase.hpp"
#include "pipelines/cycle/cycle_columns.hpp"
#include "pipelines/cycle/cycle_row.hpp"
#include "pipelines/files/columns.hpp"
#include "pipelines/files/plot_script.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// Half degrees draw a smooth loop; high harmonics get a fixed number of points per wave.
constexpr int fewest_intervals = 720;
constexpr int intervals_per_wave = 24;
/// Names of files end at 255 bytes on the usual systems; extensions and temporary names need some.
constexpr std::size_t longest_name = 200;
/// Starting Python, then what one figure in two formats takes on a slow core, ten times over.
constexpr std::chrono::seconds start_limit{60};
constexpr std::chrono::seconds figure_limit{10};

using Segments = std::vector<contact::CycleSegment>;

/// Equidistant phases and the starts of the segments, from 0 to 2π, each once.
Eigen::VectorXd phases_of(const Segments& segments, int n_harmonics) {
  const int n = std::max(fewest_intervals, intervals_per_wave * n_harmonics);
  std::vector<double> phases{contact::two_pi};
  for (int i = 0; i < n; ++i) phases.push_back(contact::two_pi * i / n);
  for (const contact::CycleSegment& segment : segments) {
    if (segment.start < contact::two_pi) phases.push_back(segment.start);
  }
  std::ranges::sort(phases);
  phases.erase(std::unique(phases.begin(), phases.end()), phases.end());
  return Eigen::Map<const Eigen::VectorXd>(phases.data(), static_cast<Eigen::Index>(phases.size()));
}

/// Of the interval that begins at `phase`. An instant at a change of state lies in both, and
/// rounding would choose; the segments do not doubt.
contact::ContactState state_from(const Segments& segments, double phase) {
  const double in_period = phase < contact::two_pi ? phase : 0.0;
  const auto next =
      std::ranges::upper_bound(segments, in_period, {}, &contact::CycleSegment::start);
  return next == segments.begin() ? segments.back().state : std::prev(next)->state;
}

std::string csv_of(const Eigen::VectorXd& phases, const contact::PointHistory& history) {
  std::string text = header_of(cycle_columns()) + '\n';
  for (Eigen::Index i = 0; i < phases.size(); ++i) {
    const contact::PointInstant& at = history.instants[static_cast<std::size_t>(i)];
    const char* const state = state_name(state_from(history.segments, phases[i]));
    text.append(row_of(cycle_columns(), {phases[i], at, state})).append("\n");
  }
  return text;
}

void require_file_name(const std::string& name, const std::string& place) {
  const auto refuse = [&](const std::string& why) {
    throw SceneError(fmt::format("{}: id: {}; --plot names files by it", place, why));
  };
  if (name.size() > longest_name) {
    refuse(fmt::format("longer than {} bytes", longest_name));
  }
  const auto unfit = [](char c) { return c == '/' || static_cast<unsigned char>(c) < 0x20; };
  if (std::ranges::any_of(name, unfit)) refuse("holds a slash or a control character");
  if (name.front() == '.') refuse("begins with a point");
}

}  // namespace

std::vector<CyclePlot> cycle_plots(const CsvTable& table) {
  if (table.n_rows() > largest_plotted_table) {
    throw SceneError(fmt::format("{}: {} rows; --plot draws at most {}", table.name(),
                                 table.n_rows(), largest_plotted_table));
  }
  const CycleColumns columns(table);
  std::vector<CyclePlot> plots;
  std::map<std::string, std::size_t> rows;
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    const CycleRow cycle = solve_row(table, columns, row, 1);
    require_file_name(cycle.id, table.row_place(row));
    if (const auto [first, is_new] = rows.emplace(cycle.id, row); !is_new) {
      throw SceneError(fmt::format("{}: id: \"{}\" stands at {} already; --plot names files by it",
                                   table.row_place(row), cycle.id, table.row_place(first->second)));
    }
    const Eigen::VectorXd phases = phases_of(cycle.history.segments, columns.n_harmonics());
    const CycleRow sampled = solve_row(table, columns, row, 1, phases);
    plots.push_back({cycle.id, csv_of(phases, sampled.history)});
  }
  return plots;
}

void write_cycle_plots(const std::vector<CyclePlot>& plots, const std::filesystem::path& folder) {
  make_folder(folder);
  require_writable(folder);  // also where the table has no rows
  for (const CyclePlot& plot : plots) write_whole(folder / (plot.name + ".csv"), plot.csv);
}

void draw_cycle_plots(const std::vector<CyclePlot>& plots, const std::filesystem::path& folder) {
  if (plots.empty()) return;
  std::vector<std::string> arguments{std::filesystem::absolute(folder).string()};
  for (const CyclePlot& plot : plots) arguments.push_back(plot.name);
  const std::string failure = run_plot_script(
      "plot_cycle.py", arguments, start_limit + figure_limit * static_cast<int>(plots.size()));
  if (!failure.empty()) throw std::runtime_error(failure);
}

}  // namespace microslip::pipelines
