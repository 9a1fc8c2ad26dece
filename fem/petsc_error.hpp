/// @file
/// Errors of the finite-element room: a PETSc or SLEPc call that failed, and results that are not
/// what was asked.
#pragma once

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

}  // namespace microslip::fem
