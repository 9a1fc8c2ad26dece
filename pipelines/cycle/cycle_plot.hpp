/// @file
/// `cycle --plot DIR`: the steady cycles of a table of contact points, sampled and drawn.
///
/// Per row DIR/ID.csv, and ID.svg and ID.png drawn from it by share/scripts/plot_cycle.py: friction
/// over u, load over v, and where the point moves along r as well friction over w and the orbit
/// f_p–f_r. The columns of the CSV are
///
///   phase_deg, u_m, v_m, w_m, friction_Pa, normal_Pa, friction_w_Pa, slip_m, slip_w_m, state
///
/// slip is the position of the slider along p and r, state the one of the interval that begins at
/// the row. The phases are equidistant, with every change of state put in between, from 0° to 360°:
/// the area of the polygon is the dissipated energy up to O(h²) of smooth arcs,
/// no corner is cut off.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/text/csv_table.hpp"

namespace microslip::pipelines {

/// More would be minutes of drawing that nobody looks at.
inline constexpr std::size_t largest_plotted_table = 200;

struct CyclePlot {
  std::string name;  ///< of the files, without extension: the id of the row
  std::string csv;
};

/// The samples of every row.
/// @throws SceneError  more than largest_plotted_table rows, an id that is no file name or stands
///         twice, and whatever cycles_as_json() refuses; with line.
[[nodiscard]] std::vector<CyclePlot> cycle_plots(const CsvTable& table);

/// Writes the CSV files; makes the folder where it is missing.
/// @throws ExhaustedError  the folder or a file cannot be written.
void write_cycle_plots(const std::vector<CyclePlot>& plots, const std::filesystem::path& folder);

/// Draws what write_cycle_plots() wrote.
/// @throws std::runtime_error  the plots could not be made.
void draw_cycle_plots(const std::vector<CyclePlot>& plots, const std::filesystem::path& folder);

}  // namespace microslip::pipelines
