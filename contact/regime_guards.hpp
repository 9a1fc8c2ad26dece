/// @file
/// Lines on a patch where the cycles of its points change their kind, as guards of a fitted rule
/// (theory sections 4.1, 4.2, 7). One set for each state q of the patch:
///
///   L₁ + L₂ − 2μn₀                 onset of slip; slip angles go like its root
///   B − n₀,  B + n₀                onset of separation, of contact; contact angles go like their roots
///   k_u u₀ − (L₂ − q), (q − L₁) − k_u u₀     ends of the band of a stuck point's mean force, where stuck
///
/// Within the separation regime forces stay smooth enough where one sequence of states gives way to
/// another, since the load is near zero there.
#pragma once

#include <functional>
#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/fitted_rule.hpp"
#include "contact/harmonics.hpp"

namespace microslip::contact {

/// Mode shapes at any points of the patch plane, (p, r) [m], n each → n × n_modes; for instance
/// ModalContactField::at.
using ShapeField =
    std::function<ModalShapes(const Eigen::VectorXd& p, const Eigen::VectorXd& r)>;
/// Constants of the contact there, n; smooth functions of position keep fitted rules small.
using ParameterField =
    std::function<std::vector<PointParameters>(const Eigen::VectorXd& p, const Eigen::VectorXd& r)>;

/// @param states  one or more q, H = 1 [m√kg]; the fields are called when the guards are.
[[nodiscard]] Guards regime_guards(ShapeField shapes, ParameterField parameters,
                                   std::vector<Harmonics> states);

}  // namespace microslip::contact
