/// @file
/// The error of the mesh from coarser ones: elements twice and four times as large.
///
///   value(h) = exact + C h^p,     2^p = (f(4h) − f(2h)) / (f(2h) − f(h))
///   error(h) = (value(2h) − value(h)) / (2^p − 1)
///
/// p is observed on the natural frequency of the first mode and kept between 1, which corners and
/// edges of a body may cost, and the 4 of smooth solutions with quadratic elements (theory 24).
/// Where it cannot be observed it is 1. Of modes that are extrapolated (extrapolated_modes.hpp)
/// value(2h) is that of modes extrapolated from 2h and 4h, and 2^p √2 times that of the modes: the
/// next term falls at least half an order faster. Elements larger than the body is thick hardly
/// grow: what the jumps of stress between them tell (given_mesh.hpp) counts where it is more.
#pragma once

#include <optional>

#include "pipelines/accuracy/richer_models.hpp"

namespace microslip::pipelines {

/// The model on elements twice as large, with `share` = −1 / (2^p − 1), or that without what the
/// jumps of stress tell.
/// @param structure  of the model.
/// @param note  what failed on the way, for the log.
/// @return empty: the scene has no element size, or a coarser mesh gives no such model.
/// @throws InterruptedError
[[nodiscard]] std::optional<RicherModel> coarser_mesh(const ReducedModel& model,
                                                      const SceneDescription& scene,
                                                      const SolvedStructure& structure,
                                                      std::string& note);

}  // namespace microslip::pipelines
