/// @file
/// Whether memory holds the solution for modes, told before it starts: a system without memory ends
/// programs without a word.
#pragma once

#include <string>

#include "fem/machine_memory.hpp"
#include "fem/solver_kind.hpp"
#include "mesh/mesh.hpp"

namespace microslip::pipelines {

struct SolverMemory {
  fem::SolverKind solver = fem::SolverKind::direct;
  /// Forecast, up to 60 % more than is used in the end; beside the program, which is there already.
  double direct_mb = 0.0;
  double iterative_mb = 0.0;  ///< the same
  fem::AvailableMemory available;

  [[nodiscard]] double needed_mb() const {
    return solver == fem::SolverKind::direct ? direct_mb : iterative_mb;
  }
};

/// Of all machines where there are several ranks, as if each had what this one has.
[[nodiscard]] fem::AvailableMemory available_memory();

[[nodiscard]] SolverMemory solver_memory(const mesh::Mesh& mesh, fem::SolverKind solver);

/// What does not fit and what would; "" where the forecast is below what is available.
[[nodiscard]] std::string memory_warning(const SolverMemory& memory);

/// @throws fem::MemoryError  the forecast, less a third that it may be wrong by, is more than is
///         available. In between the factorisation asks once more, when MUMPS knows what it needs.
void require_memory(const mesh::Mesh& mesh, fem::SolverKind solver);

/// The same, before each element is cut along each edge: eight times the unknowns take eight times
/// as much at least. @throws fem::MemoryError  as above.
void require_memory_when_cut(const mesh::Mesh& mesh, fem::SolverKind solver);

/// How often elements may be cut, up to `most` times, before memory is most likely too little.
[[nodiscard]] int cuts_in_memory(const mesh::Mesh& mesh, fem::SolverKind solver, int most);

/// What the direct way has ended with, with the way that takes less memory and its key.
[[nodiscard]] std::string with_iterative_way(std::string text);

}  // namespace microslip::pipelines
