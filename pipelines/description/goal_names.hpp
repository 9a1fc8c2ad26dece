/// @file
/// Numbers a user reads that have an error bar, and that an accuracy may be asked for
/// ([accuracy] goals).
#pragma once

namespace microslip::pipelines {

inline constexpr const char* peak_amplitude_goal = "peak_amplitude";
inline constexpr const char* peak_frequency_goal = "peak_frequency";
inline constexpr const char* dissipated_energy_goal = "dissipated_energy";  ///< at the peak
inline constexpr const char* optimum_goal = "optimum";                      ///< a best value

}  // namespace microslip::pipelines
