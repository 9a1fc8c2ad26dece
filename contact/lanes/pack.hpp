/// @file
/// Eight points side by side. The vector is eight doubles on every machine, the compiler cuts it to
/// the registers there are: results do not depend on their width but for the rounding of fused
/// products.
///
/// A set of kernels is written once, as always-inlined templates, and compiled for the plain
/// instruction set, AVX2 and AVX-512 (vector_lanes.hpp); the machine decides at run time.
#pragma once

#include <cstddef>

#include "contact/lanes/block_size.hpp"
#include "contact/numerics/vector_lanes.hpp"

namespace microslip::contact::sampled {

using Pack = Lanes<8>::Vector;

MICROSLIP_INLINE Pack pack_at(const double* from) { return lanes_at<8>(from); }
MICROSLIP_INLINE void put_pack(double* to, const Pack& pack) { put_lanes<8>(to, pack); }

MICROSLIP_INLINE Pack larger(const Pack& a, const Pack& b) { return a > b ? a : b; }
MICROSLIP_INLINE Pack smaller(const Pack& a, const Pack& b) { return a < b ? a : b; }

}  // namespace microslip::contact::sampled
