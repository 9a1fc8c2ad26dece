/// @file
/// Constants of the contact points of a model under a load.
#pragma once

#include <variant>
#include <vector>

#include "contact/surface/point_parameters.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/scene/curve_request.hpp"

namespace microslip::pipelines {

/// The preload of a curve under a model: a gap given as a length is −gap·∬k_v dA [N].
/// @throws RefusedError  a gap where the normal stiffness is zero.
[[nodiscard]] std::variant<double, LimitName> preload_of(const CurveRequest& request,
                                                         const ReducedModel& model);

/// Constants of the contact points under a preload. By the measure of the model, `load` is the total normal
/// force [N] (negative: a uniform gap −load/∬k_v dA) or scales the preload of the points.
/// @throws RefusedError  a gap where the normal stiffness is zero.
[[nodiscard]] std::vector<contact::PointParameters> point_parameters(const ReducedModel& model,
                                                                     double load, bool on_vertices);

}  // namespace microslip::pipelines
