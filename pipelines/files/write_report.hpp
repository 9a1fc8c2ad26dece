/// @file
/// Plots, report.html and report.md of a run folder, made from the files in it, so that `run` and
/// `report` give the same. Plots and report.html come from one child process,
/// share/scripts/report_run.py.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace microslip::pipelines {

/// The text of a run's summary.json.
/// @throws SceneError  no such folder, or none of a run.
[[nodiscard]] std::string read_summary(const std::filesystem::path& folder);

/// Makes plots/, report.html and report.md from a summary and the curves/ and maps/ of a run. Plots
/// that cannot be made cost the plots, not the run: they are warnings.
/// @param folder  of the run. @param into  where they are written.
/// @param summary  text of its summary.
/// @return warnings; empty when everything was made. They name a file of the run that is missing or
///         damaged, with line and column of a table.
/// @throws SceneError      a damaged summary; the message names file and place.
/// @throws ExhaustedError  report.md cannot be written.
[[nodiscard]] std::vector<std::string> write_report(const std::filesystem::path& folder,
                                                    const std::filesystem::path& into,
                                                    const std::string& summary);

/// The text of report.md. What runs of older versions did not write is left out of it.
/// @param summary_json  text of summary.json. @param plots  file names in plots/.
/// @param name          how messages call the summary.
/// @throws SceneError   not JSON, or not a run summary: "name:line:column: …" or "name: key.path:
///         …".
[[nodiscard]] std::string report_text(const std::string& summary_json,
                                      const std::vector<std::string>& plots,
                                      const std::string& name = "summary.json");

}  // namespace microslip::pipelines
