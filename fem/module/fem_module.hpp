/// @file
/// What is solved with PETSc and SLEPc, as a module. The two bring a hundred libraries, whose
/// symbols take 0.1 s of every start to join: `microslip` opens the module with its first session,
/// which a scene without finite elements never has. Other programs link it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem/eigen/structure_solver.hpp"
#include "fem/modal_analysis.hpp"

namespace microslip::fem {

struct FemModule {
  const char* headers = nullptr;  ///< fingerprint of those that program and module share
  /// Starts PETSc, SLEPc and MPI, and meets the other ranks. @return n_ranks_here().
  int (*open)() = nullptr;
  void (*close)() = nullptr;
  /// As the constructors of Structure.
  std::unique_ptr<StructureSolver> (*assembled)(const mesh::Mesh& mesh, const Material& material,
                                                const std::vector<std::string>& clamped,
                                                Tet10Rule rule, SolverKind solver) = nullptr;
  std::unique_ptr<StructureSolver> (*given)(const mesh::Mesh& mesh, const GivenMatrices& matrices,
                                            SolverKind solver) = nullptr;
};

/// Name of the one function that the file of the module shows; it returns a const FemModule*.
inline constexpr const char* fem_module_symbol = "microslip_fem_module";

/// The module itself, where it is linked.
[[nodiscard]] const FemModule& linked_fem_module();

/// The module that this program uses: linked (linked_module.cpp), or opened by the first call
/// (opened_module.cpp).
/// @throws MemoryError         the address space does not hold it.
/// @throws std::runtime_error  its file does not lie beside the program, or is not of it.
[[nodiscard]] const FemModule& fem_module();

}  // namespace microslip::fem
