/// @file
/// The one place where an exception becomes an exit code (interfaces.md section 1).
#pragma once

#include <exception>
#include <string>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

[[nodiscard]] ExitCode exit_code_of(const std::exception& error);

/// What is said of it: the words of a library are not left to themselves.
[[nodiscard]] std::string message_of(const std::exception& error);

}  // namespace microslip::pipelines
