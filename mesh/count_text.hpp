/// @file
/// Counts in messages: "1 face lies", "3 faces lie".
#pragma once

#include <string>
#include <string_view>

namespace microslip::mesh {

/// @param one   what follows 1.  @param many  what follows any other count.
[[nodiscard]] inline std::string counted(auto count, std::string_view one, std::string_view many) {
  return std::to_string(count) + ' ' + std::string(count == 1 ? one : many);
}

}  // namespace microslip::mesh
