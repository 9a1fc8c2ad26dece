/// @file
/// All that the file of the module shows (fem_module_symbol).

#include "fem/module/fem_module.hpp"

extern "C" [[gnu::visibility("default")]] const microslip::fem::FemModule* microslip_fem_module() {
  return &microslip::fem::linked_fem_module();
}
