/// @file
/// Errors of the finite-element room: a PETSc or SLEPc call that failed, and results that are not
/// what was asked.
#pragma once

#include <source_location>
#include <stdexcept>

namespace microslip::fem {

class PetscError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Diagnosis in front: "eigen-missed-mode: …", "rigid-body: …".
class EigenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The machine's memory does not hold the factorisation; names the size that was asked for.
class MemoryError : public PetscError {
 public:
  using PetscError::PetscError;
};

/// Turns the code of a PETSc, SLEPc or MPI call into a PetscError; 0 passes.
/// @throws PetscError  the library's own words, its function, and where it was called from.
void check(int code, std::source_location where = std::source_location::current());

/// Makes PETSc return codes silently and keep the words of the first error for check().
void install_error_handler();

}  // namespace microslip::fem
