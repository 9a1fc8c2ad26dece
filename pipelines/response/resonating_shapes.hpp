/// @file
/// Attachment shapes answer like springs, but as coordinates they have resonances, which no
/// structure has. Contact that closes is a shock, whose harmonics reach them (theory section 22): 2
/// % at a peak of the default blade.
#pragma once

#include <Eigen/Core>

#include "solver/response_curve.hpp"

namespace microslip::pipelines {

/// Open for more of the period at some points of the curve than at others, or at its only one.
[[nodiscard]] bool opens_and_closes(const solver::ResponseCurve& curve);

/// Adds a sentence to the message of a curve whose contact opens and closes,
/// where its harmonics reach a shape.
/// @param frequency     ω as solved with [rad/s]; the last n_attachment are those of attachment
///                      shapes.
/// @param highest       harmonic of the solutions; of motions integrated in time: infinite.
void tell_shapes_resonate(const Eigen::VectorXd& frequency, Eigen::Index n_attachment,
                          double highest, solver::ResponseCurve& curve);

/// The same of chosen harmonics that end where the modes do: those above were not asked what they
/// do, and no bar has it (at 267 N on the default blade 0.9 % of the peak).
/// @param highest  harmonic that was asked.   @param most  harmonic that choosing asks otherwise.
void tell_unasked(int highest, int most, solver::ResponseCurve& curve);

}  // namespace microslip::pipelines
