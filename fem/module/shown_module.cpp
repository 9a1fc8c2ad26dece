/// @file
/// All that the file of the module shows (solver_module_symbol).

#include "fem/module/solver_module.hpp"

extern "C" [[gnu::visibility("default")]] const microslip::fem::SolverModule*
microslip_solver_module() {
  return &microslip::fem::linked_solver_module();
}
