/// @file
/// The highest peak of a curve solved with more harmonics than were given.
#pragma once

#include <functional>

#include "pipelines/model/reduced_model.hpp"
#include "pipelines/response/run_results.hpp"

namespace microslip::pipelines {

/// The highest harmonic that results of a scene with given harmonics are checked with; 0: they are
/// chosen, there is no contact, nothing is asked of errors, or a scene can have none higher.
[[nodiscard]] int harmonics_to_check(const ReducedModel& model, const SceneDescription& scene);

/// Solves the highest peak with more harmonics than were given,
/// where the contact is not proved linear: result.richer. When it is stopped the message of the
/// curve says so instead.
/// @param stop  asked between its steps.
void check_harmonics(
    ReducedModel model, const SceneDescription& scene, double load, CurveResult& result,
    const std::function<bool()>& stop = [] { return false; });

/// Of accuracy.budget, what one curve may take to be checked with more harmonics: other curves want
/// to begin before it ends.
inline constexpr double share_of_check = 0.1;

}  // namespace microslip::pipelines
