/// @file
/// The command `report`.
#pragma once

#include <filesystem>

namespace microslip::pipelines {

/// `report`: plots and report from a run folder.
int report_study(const std::filesystem::path& folder);

}  // namespace microslip::pipelines
