/// @file
/// Lines on a patch where the cycles of its points change their kind, as guards of a fitted rule
/// (theory sections 4.1, 4.2, 7). One set for each state q of the patch:
///
///   L₁ + L₂ − 2μn₀                 onset of slip; slip angles go like its root
///   B − n₀,  B + n₀                onset of separation, of contact; contact angles go like their roots
///   k_u u₀ − (L₂ − q), (q − L₁) − k_u u₀     ends of the band of a stuck point's mean force, where stuck
///
///   X² − L₁²(B² − n₀²),  X² − L₂²(B² − n₀²)  slip begins or ends at the instant of contact or separation
///                                  (ẇ_P, ẇ_N = 0 there), where separated; X = k_u k_v (u_s v_c − u_c v_s)
///
/// The last follow from sin(δ+γ−θ_P) sin(δ−γ−θ_P) = sin²(δ−θ_P) − sin²γ with cos γ = −n₀/B: where one
/// sequence of states gives way to another within the separation regime. Forces kink mildly there; without
/// these lines the error of a patch with separation stays at 1e-8, with them it falls on (bench_quadrature).
#pragma once

#include <functional>
#include <vector>

#include "contact/contact_patch.hpp"
#include "contact/force/fitted_rule.hpp"
#include "contact/harmonics.hpp"

namespace microslip::contact {

/// Mode shapes at any points of the patch plane, (p, r) [m], n each → n × n_modes; for instance
/// ModalContactField::at.
using ShapeField = std::function<ModalShapes(const Eigen::VectorXd& p, const Eigen::VectorXd& r)>;
/// Constants of the contact there, n; smooth functions of position keep fitted rules small.
using ParameterField =
    std::function<std::vector<PointParameters>(const Eigen::VectorXd& p, const Eigen::VectorXd& r)>;

/// @param states  one or more q, H = 1 [m√kg]; the fields are called when the guards are.
[[nodiscard]] Guards regime_guards(ShapeField shapes, ParameterField parameters,
                                   std::vector<Harmonics> states);

}  // namespace microslip::contact
