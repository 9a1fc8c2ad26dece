/// @file
/// Work of the slider of a sampled point with a smooth surface: ∮ μ n |ds|, the slider at the end
/// of the band that takes it along, over the parts of the steps in which one does (kinks.hpp).
/// Of third order in the step.
#pragma once

#include <cstddef>

#include "contact/sampled/kinks.hpp"

namespace microslip::contact::sampled {

/// @param state  of the instants, a column of a block.   @param n  instants.
/// @return  over the period [J/m²].
[[nodiscard]] double slip_work(const SmoothPoint& point, const LineColumns& columns,
                               const double* state, std::size_t n);

}  // namespace microslip::contact::sampled
