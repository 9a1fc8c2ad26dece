/// @file
/// Errors of MPI where PETSc may not be loaded.
#pragma once

#include <source_location>

namespace microslip::fem {

/// Turns the code of an MPI call into a PetscError; MPI_SUCCESS passes.
/// @throws PetscError  MPI's own words, and where it was called from.
void check_mpi(int code, std::source_location where = std::source_location::current());

}  // namespace microslip::fem
