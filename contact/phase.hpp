/// @file
/// The phase θ = ω t of a period [rad].
#pragma once

#include <numbers>

namespace microslip::contact {

inline constexpr double two_pi = 2.0 * std::numbers::pi;

}  // namespace microslip::contact
