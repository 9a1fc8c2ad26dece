/// @file
/// summary.json: what a run found and what it cost, for scripts (interfaces.md section 3.1).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "pipelines/response/run_summary.hpp"

namespace microslip::pipelines {

/// The text of summary.json; on one line when `indent` is −1.
[[nodiscard]] std::string summary_json(const RunSummary& summary, int indent = 2);

/// Behind the message, for what a later run has to say here that finds no room for a file
/// (failure_in_place.hpp).
constexpr std::size_t blanks_behind_message = 160;

/// @throws ExhaustedError  cannot be written.
void write_summary(const std::filesystem::path& file, const RunSummary& summary);

/// The array `effects` of it, alone.
[[nodiscard]] std::string effects_json(const std::vector<EffectRecord>& effects);

}  // namespace microslip::pipelines
