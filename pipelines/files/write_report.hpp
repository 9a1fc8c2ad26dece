/// @file
/// Plots and report.md of a run folder, made from the files in it, so that `run` and `report` give the
/// same. The plots come from one child process, share/scripts/plot_run.py.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace microslip::pipelines {

/// Writes plots/ and report.md from summary.json, curves/ and maps/. Plots that cannot be made cost
/// the plots, not the run: they are warnings.
/// @return warnings; empty when everything was made.
/// @throws SceneError      no summary.json, or a damaged one; the message names file and place.
/// @throws ExhaustedError  report.md cannot be written.
[[nodiscard]] std::vector<std::string> write_report(const std::filesystem::path& folder);

/// The same where the plots are what was asked for.
/// @throws SceneError  a file of the run is missing or damaged: the message names it, with line and column of a
///         table; what could be drawn without it is drawn.
void rebuild_report(const std::filesystem::path& folder);

/// The text of report.md. What runs of older versions did not write is left out of it.
/// @param summary_json  text of summary.json. @param plots  file names in plots/.
/// @param name          how messages call the summary.
/// @throws SceneError   not JSON, or not a run summary: "name:line:column: …" or "name: key.path: …".
[[nodiscard]] std::string report_text(const std::string& summary_json,
                                      const std::vector<std::string>& plots,
                                      const std::string& name = "summary.json");

}  // namespace microslip::pipelines
