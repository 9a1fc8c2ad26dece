/// @file
/// A run that fails as there is no room: a whole summary.json beside the present one has none
/// either.
#pragma once

#include <filesystem>
#include <string_view>

#include "pipelines/system/exit_code.hpp"

namespace microslip::pipelines {

/// What stands in summary.json until a run has come to its end, beside the exit code of an
/// incomplete one.
constexpr std::string_view unfinished_message =
    "the run has not come to its end: it goes on, or was killed; --resume goes on";

/// Writes exit code and message over those of an unfinished run, which takes no room. Does nothing
/// where they say something else, or cannot be written.
void tell_failure_in_place(const std::filesystem::path& summary, ExitCode code);

}  // namespace microslip::pipelines
