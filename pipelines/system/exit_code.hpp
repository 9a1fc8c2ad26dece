/// @file
/// The one place where an exception becomes an exit code (interfaces.md section 1).
#pragma once

#include <exception>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

[[nodiscard]] ExitCode exit_code_of(const std::exception& error);

}  // namespace microslip::pipelines
