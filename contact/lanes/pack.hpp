/// @file
/// Points side by side, as many as a register holds: a vector that is longer than the registers is
/// cut by the compiler number by number, through memory (measured on AVX2: curves take three to
/// four times as long). Results do not depend on the width but for the rounding of fused products.
///
/// A set of kernels is written once, as always-inlined templates of the vector, and compiled for
/// the plain instruction set, AVX2 and AVX-512 (vector_lanes.hpp); the machine decides at run time.
#pragma once

#include <cmath>
#include <cstddef>

#include "contact/lanes/block_size.hpp"
#include "contact/numerics/vector_lanes.hpp"

namespace microslip::contact::sampled {

template <class Pack>
inline constexpr std::size_t pack_size = sizeof(Pack) / sizeof(double);
/// Of a block.
template <class Pack>
inline constexpr std::size_t block_packs = block_size / pack_size<Pack>;

template <class Pack>
MICROSLIP_INLINE Pack pack_at(const double* from) {
  return lanes_at<pack_size<Pack>>(from);
}
template <class Pack>
MICROSLIP_INLINE void put_pack(double* to, const Pack& pack) {
  put_lanes<pack_size<Pack>>(to, pack);
}

template <class Pack>
MICROSLIP_INLINE Pack larger(const Pack& a, const Pack& b) {
  return a > b ? a : b;
}
template <class Pack>
MICROSLIP_INLINE Pack smaller(const Pack& a, const Pack& b) {
  return a < b ? a : b;
}

/// GCC knows no root of a vector; those of its numbers are one instruction all the same.
template <class Pack>
MICROSLIP_INLINE Pack root_of(const Pack& x) {
  Pack root;
  for (std::size_t i = 0; i < pack_size<Pack>; ++i) root[i] = std::sqrt(x[i]);
  return root;
}

}  // namespace microslip::contact::sampled
