/// @file
/// Numbers with as many digits as their error allows.
#pragma once

#include <string>

namespace microslip::pipelines {

/// "280 ± 20": value and half width to the first digit of the half width,
/// to two where that is a one.
/// @param bar  relative half width, > 0; below 1e-8 the value alone, to eight digits.
[[nodiscard]] std::string with_half_width(double value, double bar);

/// "280": the value alone, with the digits it has in with_half_width().
[[nodiscard]] std::string with_digits_of(double value, double bar);

/// "0.12 %", "13 %", "649 %": two digits, from 10 % on whole.
[[nodiscard]] std::string percent_text(double share);

/// The same with its sign: "+0.12 %".
[[nodiscard]] std::string signed_percent_text(double share);

}  // namespace microslip::pipelines
