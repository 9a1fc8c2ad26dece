/// @file
/// The load of a curve under a model: a preload, a factor on rest loads, or a limit.
#pragma once

#include <optional>
#include <variant>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/model/reduced_model.hpp"

namespace microslip::pipelines {

/// Σ∬k_v dA of all patches [N/m].
[[nodiscard]] double total_normal_stiffness(const ReducedModel& model);

/// A gap given as a length is −gap·Σ∬k_v dA [N].
/// @throws RefusedError  a gap, or a load below 0, where the normal stiffness is zero.
[[nodiscard]] std::variant<double, LimitName> load_of(const CurveRequest& request,
                                                      const ReducedModel& model);

/// Width of the uniform gap that a load below 0 is [m]; none where it presses,
/// or where loads are scales.
[[nodiscard]] std::optional<double> gap_of(const std::variant<double, LimitName>& load,
                                           const ReducedModel& model);

}  // namespace microslip::pipelines
