/// @file
/// Quantities as users write them: a number (SI) or a number with a unit ("210 GPa", "0.2 %").
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace microslip::pipelines {

/// What is wrong with a quantity, without its place.
class UnitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Value of `text` in `unit`.
/// @param text  number, blanks, unit in UDUNITS notation;
///              without a unit the number is taken as it is.
/// @param unit  SI unit expected, "1" for a pure number.
/// @throws UnitError  not a number, an unknown unit, or one of another dimension; the reciprocal is
///         another ("0.01 s" is not 100 Hz), and so are turns, but for frequencies:
///         a turn per second is 1 Hz.
/// @note to_si("210 GPa", "Pa") is 2.1e11; to_si("0.2 %", "1") is 0.002; to_si("60 rpm",
///       "Hz") is 1.
[[nodiscard]] double to_si(std::string_view text, const std::string& unit);

/// Of an angular frequency, as it was given: of the neighbouring numbers that all become this one
/// when multiplied by 2π that with the fewest digits. @param angular  [rad/s].   @return [Hz]
[[nodiscard]] double in_hertz(double angular);

/// Whether it is 0 or of a size from 1e-100 to 1e100: no unit needs more, and products of a few
/// such numbers neither vanish nor overflow.
[[nodiscard]] bool is_of_usable_size(double value);

/// The whole text as a finite or infinite number, in any locale. @throws UnitError  it is none.
[[nodiscard]] double parse_number(std::string_view text);

}  // namespace microslip::pipelines
