/// @file
/// Which effects of contact a run simulates, and the contact of a model under a load.
#pragma once

#include <utility>

#include "contact/contact_force.hpp"
#include "pipelines/description/scene_description.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

/// Decides what `auto` in [effects] leaves open.
/// @param model  with its patches.
/// @throws RefusedError  friction along r is asked for, and the stiffness there is not positive; an
///                       effect is switched off that no method can leave out.
[[nodiscard]] ContactEffects contact_effects(const ReducedModel& model,
                                             const SceneDescription& scene);

/// The contact of a model under the load of a curve: what the solver,
/// integration in time and maps ask.
/// @param model  with patches; borrowed.
/// @param load   by the measure of the model: the total normal force [N] (negative: a uniform gap
///               −load/∬k_v dA), or a factor on the rest loads that are given.
/// @throws RefusedError  no such load.
[[nodiscard]] contact::ContactForce contact_of(const ReducedModel& model, double load);

/// What `task` returns. @throws RefusedError  in place of contact::LoadError.
template <typename Task>
[[nodiscard]] auto or_refused(const Task& task) {
  try {
    return task();
  } catch (const contact::LoadError& error) {
    throw RefusedError(error.what());
  }
}

}  // namespace microslip::pipelines
