#include "fem/petsc_error.hpp"

#include <filesystem>
#include <string>

#include "fem/petsc_check.hpp"

namespace microslip::fem {

void check(PetscErrorCode code, std::source_location place) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw PetscError(std::string("PETSc: ") + (text != nullptr ? text : "unknown error") + " (code " +
                   std::to_string(code) + ", " +
                   std::filesystem::path(place.file_name()).filename().string() + ":" +
                   std::to_string(place.line()) + ")");
}

}  // namespace microslip::fem
