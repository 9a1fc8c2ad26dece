#include "fem/petsc/guarded_solver.hpp"

#include "fem/petsc/petsc_check.hpp"

namespace microslip::fem {
namespace {

PetscErrorCode apply_solver(PC preconditioner, Vec rhs, Vec solution) {
  void* context = nullptr;
  const PetscErrorCode code = PCShellGetContext(preconditioner, &context);
  if (code != 0) return code;
  auto& guarded = *static_cast<GuardedSolver*>(context);
  try {
    guarded.solver.apply(rhs, solution);
  } catch (...) {
    guarded.failure = std::current_exception();
    return PETSC_ERR_LIB;
  }
  return 0;
}

}  // namespace

void use_solver(PC preconditioner, GuardedSolver& guarded) {
  check(PCSetType(preconditioner, PCSHELL));
  check(PCShellSetContext(preconditioner, &guarded));
  check(PCShellSetApply(preconditioner, apply_solver));
}

}  // namespace microslip::fem
