/// @file
/// How much memory a direct factorisation will take, told by the mesh alone before anything is
/// assembled: time to refuse, or to go the iterative way.
///
/// The elements are halved again and again by planes across an axis, where few nodes lie (nested
/// dissection). Nodes that both halves of a piece have, and nothing outside it, are eliminated
/// together when the halves meet:
///
///   9 [s (s + 1)/2 + s b]                                                                      (1)
///
/// numbers of the factor, for s nodes eliminated and b nodes on the border of the piece. A slender
/// blade has small borders and a compact block large ones: of 100 000 unknowns each they differ by
/// a factor of three, which no power of the number of unknowns knows.
///
/// Source: George, SIAM J. Numer. Anal. 10 (1973) 345–363.
#pragma once

#include "mesh/mesh.hpp"

namespace microslip::fem {

/// Numbers in the factor of the whole mesh, held nowhere: (1) over the dissection.
/// @note n log n: some seconds for a million unknowns.
[[nodiscard]] double factor_size(const mesh::Mesh& mesh);

/// What modes and static shapes take [MB], by the SolverKind of fem/modal_analysis.hpp.
struct MemoryForecast {
  double matrices = 0.0;  ///< K, M, what is made of them, vectors
  /// The factorisation, as MUMPS will ask for it (within 30 %); the levels of multigrid, among them
  /// the factorisation of the corners of quadratic elements.
  double solver = 0.0;
  [[nodiscard]] double total() const { return matrices + solver; }
};

[[nodiscard]] MemoryForecast direct_memory(const mesh::Mesh& mesh);
[[nodiscard]] MemoryForecast iterative_memory(const mesh::Mesh& mesh);

}  // namespace microslip::fem
