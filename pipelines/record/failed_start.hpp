/// @file
/// A run that fails before it has solved anything, in the folder of an earlier one: the results
/// there stay, and summary.json tells of the run that failed. `exit_code` and `message` are its
/// own, those of the earlier run are in `earlier`.
#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "pipelines/system/exit_code.hpp"

namespace microslip::pipelines {

/// @param summary  of the earlier run, summary.json or where it is kept aside.
/// @return the text that takes its place.
/// @throws SceneError  it is no JSON object.
[[nodiscard]] std::string summary_of_failed_start(const std::filesystem::path& summary,
                                                  ExitCode code, const std::string& message);

/// The same in a folder whose run has come to its end; does nothing where there is none,
/// or where another is writing.
/// @throws ExhaustedError  it has no room; summary.json says so as far as it can in place.
void tell_failed_start(const std::filesystem::path& folder, ExitCode code,
                       const std::string& message);

/// What may refuse a run before it has a record of its own. @return what `work` returns.
template <typename Work>
auto begin_in(const std::filesystem::path& folder, const Work& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    tell_failed_start(folder, exit_code_of(error), error.what());
    throw;
  }
}

}  // namespace microslip::pipelines
