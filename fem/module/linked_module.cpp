#include "fem/module/solver_module.hpp"

namespace microslip::fem {

const SolverModule& solver_module() { return linked_solver_module(); }

}  // namespace microslip::fem
