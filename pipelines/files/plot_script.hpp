/// @file
/// The scripts that draw, each a child process of the program: share/scripts/plot_*.py.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace microslip::pipelines {

/// Runs a script of share/scripts.
/// @param name  file name, e.g. "plot_run.py".
/// @return empty when the script succeeded, else "not every plot was made: " and why.
/// @throws ExhaustedError  what it draws has no room: a full disk, a limit of file size.
[[nodiscard]] std::string run_plot_script(const std::string& name,
                                          const std::vector<std::string>& arguments,
                                          std::chrono::milliseconds limit);

}  // namespace microslip::pipelines
