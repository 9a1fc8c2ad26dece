/// @file
/// What a misspelt name was meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace microslip::pipelines {

/// The name among `known` that is nearest to `name` by edits, whatever its capitals, or that of the
/// quantity a symbol stands for ("mu": "friction_coefficient"); empty when none is near.
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       std::span<const std::string_view> known);

}  // namespace microslip::pipelines
