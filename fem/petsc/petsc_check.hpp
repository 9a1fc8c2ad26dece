/// @file
/// Codes that PETSc, SLEPc and MPI return.
#pragma once

#include <source_location>

namespace microslip::fem {

/// Turns the code of a PETSc, SLEPc or MPI call into a PetscError; 0 passes.
/// @throws PetscError  the library's own words, its function, and where it was called from.
void check(int code, std::source_location where = std::source_location::current());

/// Makes PETSc return codes silently and keep the words of the first error for check().
void install_error_handler();

}  // namespace microslip::fem
