/// @file
/// Eight points side by side. The vector is eight doubles on every machine, the compiler cuts it to the
/// registers there are: results do not depend on their width but for the rounding of fused products.
///
/// A set of kernels is written once, as always-inlined templates, and compiled for the plain instruction
/// set, AVX2 and AVX-512 (vector_lanes.hpp); the machine decides at run time.
#pragma once

#include <cstddef>

#include "contact/numerics/vector_lanes.hpp"
#include "contact/sampled/block_size.hpp"

namespace microslip::contact::sampled {

using Pack [[gnu::vector_size(64), gnu::aligned(8), gnu::may_alias]] = double;

MICROSLIP_INLINE const Pack& pack_at(const double* from) {
  return *reinterpret_cast<const Pack*>(from);
}
MICROSLIP_INLINE Pack& pack_at(double* to) { return *reinterpret_cast<Pack*>(to); }

MICROSLIP_INLINE Pack larger(const Pack& a, const Pack& b) { return a > b ? a : b; }
MICROSLIP_INLINE Pack smaller(const Pack& a, const Pack& b) { return a < b ? a : b; }

}  // namespace microslip::contact::sampled
