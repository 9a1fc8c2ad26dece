/// @file
/// One of our solvers as a preconditioner of PETSc: an exception must not pass through the library,
/// and is kept until the library has returned.
#pragma once

#include <exception>

#include <petscksp.h>

#include "fem/petsc/linear_solver.hpp"

namespace microslip::fem {

/// A solver, and what it has thrown.
struct GuardedSolver {
  const LinearSolver& solver;
  std::exception_ptr failure{};

  /// Throws what was kept.
  void rethrow() const {
    if (failure) std::rethrow_exception(failure);
  }
};

/// The preconditioner solves by `guarded`, which must outlive it.
void use_solver(PC preconditioner, GuardedSolver& guarded);

}  // namespace microslip::fem
