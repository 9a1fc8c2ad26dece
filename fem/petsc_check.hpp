/// @file
/// Return codes of PETSc and SLEPc become exceptions.
#pragma once

#include <source_location>
#include <type_traits>

#include <petscsys.h>

#include "fem/petsc_error.hpp"

namespace microslip::fem {

static_assert(std::is_same_v<PetscScalar, double>, "a PETSc built for real double numbers is needed");

/// @throws PetscError  code is not 0: PETSc's text for it and the place of the call.
void check(PetscErrorCode code, std::source_location place = std::source_location::current());

}  // namespace microslip::fem
