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
/// @throws SceneError      no summary.json, or one that cannot be read.
/// @throws ExhaustedError  report.md cannot be written.
[[nodiscard]] std::vector<std::string> write_report(const std::filesystem::path& folder);

/// The same where the plots are what was asked for.
/// @throws std::runtime_error  the plots could not be made.
void rebuild_report(const std::filesystem::path& folder);

/// The text of report.md. @param summary_json  text of summary.json. @param plots  file names in plots/.
/// @throws SceneError  not JSON, or not a run summary.
[[nodiscard]] std::string report_text(const std::string& summary_json,
                                      const std::vector<std::string>& plots);

}  // namespace microslip::pipelines
