/// @file
/// How many points go through the instants together.
#pragma once

#include <cstddef>

namespace microslip::contact::sampled {

/// Two of the widest vectors (pack.hpp): enough to hide the time of one operation behind others.
inline constexpr std::size_t block_size = 16;

}  // namespace microslip::contact::sampled
