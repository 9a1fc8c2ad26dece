/// @file
/// How K u = f is solved.
#pragma once

#include <cstdint>

namespace microslip::fem {

enum class SolverKind : std::uint8_t {
  direct,  ///< LDLᵀ by MUMPS: fast, modes are counted; memory grows as n^1.3
  /// Conjugate gradients with algebraic multigrid: memory grows as n, slower,
  /// modes are not counted.
  iterative,
};

}  // namespace microslip::fem
