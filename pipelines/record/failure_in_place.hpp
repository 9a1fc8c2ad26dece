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

/// In the summary of a run that has ended, of one that found no room to begin in its folder: exit
/// code 4 and a message, in the blanks behind the message, which is kept with its code as
/// `earlier`. Only the exit code where there are no such blanks. Takes no room either.
void tell_failed_start_in_place(const std::filesystem::path& summary);

}  // namespace microslip::pipelines
