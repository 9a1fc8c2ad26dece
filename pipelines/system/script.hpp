/// @file
/// The scripts of share/scripts, which the program starts as children.
#pragma once

#include <string>
#include <vector>

namespace microslip::pipelines {

/// What runs a script: the interpreter and the path of the script, found beside the source tree's
/// build, beside an installed program, or where the program was built.
/// @param name  file name, e.g. "plot_run.py".
/// @throws SceneError  it is not there, or the package beside it; where they are expected.
[[nodiscard]] std::vector<std::string> script_command(const std::string& name);

}  // namespace microslip::pipelines
