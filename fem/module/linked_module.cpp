#include "fem/module/fem_module.hpp"

namespace microslip::fem {

const FemModule& fem_module() { return linked_fem_module(); }

}  // namespace microslip::fem
