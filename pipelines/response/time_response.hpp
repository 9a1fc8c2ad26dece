/// @file
/// `method = "time"`: steady states of a scene by integration in time, swept over the range from
/// its begin to its end, as a response curve like any other.
#pragma once

#include <cstdint>
#include <functional>

#include "contact/harmonics.hpp"
#include "pipelines/description/scene_description.hpp"
#include "solver/continuation.hpp"
#include "solver/response_curve.hpp"
#include "solver/scene.hpp"

namespace microslip::pipelines {

/// The fixed steps a period is asked to have are enough at every frequency of the range: known
/// before anything is integrated. Nothing is asked: nothing is checked.
/// @param scene  with `transient`.
/// @throws SceneError  they are too few; the message has the number needed, and at which frequency.
void require_steps(const solver::Scene& scene, const ResponseDescription& response);

/// How close to the steady state, and by which steps.
enum class Closeness : std::uint8_t {
  result,  ///< of motions that are told
  bound,   ///< of what an effect changes, which counts from some 1e-3 on: to 1e-5 of the motion
};

/// Periodic motions only become points; the others are counted in the message (diagnosis
/// `not-periodic`).
/// @param scene  with `transient`.
/// @param stop   asked after each period: true ends the curve with the points it has.
/// @param begin  a motion at the first frequency, on which sliders follow for two periods first;
///               nullptr: from rest.
/// @param closely  fixed steps are as given.
[[nodiscard]] solver::ResponseCurve integrate_curve(const solver::Scene& scene,
                                                    const SceneDescription& description,
                                                    const solver::PointObserver& observe,
                                                    const std::function<bool()>& stop,
                                                    const contact::Harmonics* begin = nullptr,
                                                    Closeness closely = Closeness::result);

}  // namespace microslip::pipelines
