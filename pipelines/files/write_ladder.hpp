/// @file
/// Tables of `converge`: converge/KNOB.csv, and the same for a reader.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipelines/accuracy/convergence.hpp"

namespace microslip::pipelines {

/// A row per rung and curve:
/// `value,seconds,cpu_seconds,peak_amplitude_m,peak_frequency_Hz,true_error,estimated_error,
/// order,curve,runs`; empty where it is not known. @throws ExhaustedError  cannot be written.
void write_ladder_csv(const std::filesystem::path& file, const std::vector<RungResult>& rungs);

/// The table as text, errors in per cent.
[[nodiscard]] std::string ladder_text(const std::string& knob,
                                      const std::vector<RungResult>& rungs);

}  // namespace microslip::pipelines
