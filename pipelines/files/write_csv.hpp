/// @file
/// Tables of a run folder (interfaces.md sections 3 and 3.2): curves, modal unknowns, modes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// The text of curves/NAME.csv: one row per solution point, in branch order.
/// @param patches  shares of each patch, where there are several.
/// @param band     `amplitude_low_m` and `amplitude_high_m` join the columns.
[[nodiscard]] std::string curve_table(const solver::ResponseCurve& curve,
                                      const std::vector<PatchShares>& patches = {},
                                      const std::optional<AmplitudeBand>& band = {});

/// The text of curves/NAME.states.csv: `frequency_Hz,q_mean_1…,q_sin1_1…,q_cos1_1…` [Hz, m√kg].
/// @param n_modes  width of the header, for a curve without points.
[[nodiscard]] std::string states_table(const solver::ResponseCurve& curve, Eigen::Index n_modes);

/// Both files of one curve into `folder`/curves, which is created.
/// @throws ExhaustedError  cannot be written.
void write_curve(const std::filesystem::path& folder, const CurveResult& result,
                 Eigen::Index n_modes);

/// One row per mode. Members that are shorter than `frequency` leave the rest of their column
/// empty.
struct ModeTable {
  Eigen::VectorXd frequency;  ///< ω [rad/s], N
  Eigen::VectorXd
      residual;  ///< of the eigenpair [-]; none for modes that were given, and attachment shapes
  Eigen::VectorXd damping_ratio;  ///< [-]
  Eigen::VectorXd fit_error;      ///< of the fitted contact field, relative [-]
  Eigen::Index n_attachment = 0;  ///< so many of them, the last, are attachment shapes
};

/// modes.csv: `mode,frequency_Hz,residual,damping_ratio,fit_error,kind`;
/// kind is free or attachment.
/// @throws ExhaustedError  cannot be written.
void write_modes_csv(const std::filesystem::path& file, const ModeTable& modes);

/// The trace of a best value: peak_against_preload.csv with
/// `preload_N,frequency_Hz,amplitude_m,at,mark`, or peak_against_parameter.csv with `value` in
/// front; `mark` = optimum on its row, flat on those of a minimum that is the same for all.
/// @throws ExhaustedError  cannot be written.
void write_optimum_csv(const std::filesystem::path& folder, const OptimumRequest& request,
                       const solver::Optimum& optimum);

}  // namespace microslip::pipelines
