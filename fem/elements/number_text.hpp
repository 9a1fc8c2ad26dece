/// @file
/// Numbers in messages: six digits, whatever their size.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace microslip::fem {

[[nodiscard]] inline std::string number_text(double value) {
  std::array<char, 32> text{};  // "-1.23457e-308" fits
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

}  // namespace microslip::fem
