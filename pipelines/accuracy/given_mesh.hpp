/// @file
/// The error of a mesh that has no coarser one beside it: what its elements do to natural
/// frequencies is told by the jumps of stress between them (structure/mesh_excess.hpp).
#pragma once

#include <optional>

#include "pipelines/accuracy/richer_models.hpp"

namespace microslip::pipelines {

/// The model with the natural frequencies its elements would have without their error. Modes that
/// nothing is told of, those above the range and the attachment shapes, err as the worst that is.
/// Shapes stay, whose error makes up for some of what that does to amplitudes. What is told of
/// frequencies is 0.5 to 2 times their error (fem/stress_jumps.hpp).
/// @return empty: modes of another code, a body that rotates, or elements of first order, which
///         lock: of them the jumps tell a part.
[[nodiscard]] std::optional<RicherModel> without_mesh_excess(const ReducedModel& model,
                                                             const SceneDescription& scene,
                                                             const SolvedStructure& structure);

}  // namespace microslip::pipelines
