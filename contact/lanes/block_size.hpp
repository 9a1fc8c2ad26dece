/// @file
/// How many points go through the instants together.
#pragma once

#include <cstddef>

namespace microslip::contact::sampled {

/// Of one vector (pack.hpp).
inline constexpr std::size_t pack_size = 8;
/// Enough to hide the time of one operation behind the others.
inline constexpr std::size_t block_packs = 2;
inline constexpr std::size_t block_size = pack_size * block_packs;

}  // namespace microslip::contact::sampled
