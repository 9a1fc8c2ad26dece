/// @file
/// The scripts of share/scripts, which the program starts as children.
#pragma once

#include <string>
#include <vector>

namespace microslip::pipelines {

/// What runs a script: the interpreter and the path of the script, found beside the source tree's
/// build, beside an installed program, or where the program was built.
/// @param name  file name, e.g. "plot_run.py".
/// @throws std::runtime_error  it is not there; where was looked.
[[nodiscard]] std::vector<std::string> script_command(const std::string& name);

}  // namespace microslip::pipelines
