#include "fem/process/mpi_error.hpp"

#include <array>
#include <filesystem>
#include <string>

#include <mpi.h>

#include "fem/petsc_error.hpp"

namespace microslip::fem {

void check_mpi(int code, std::source_location where) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> words{};
  int length = 0;
  MPI_Error_string(code, words.data(), &length);
  throw PetscError("MPI error " + std::to_string(code) + " at " +
                   std::filesystem::path(where.file_name()).filename().string() + ':' +
                   std::to_string(where.line()) + ": " +
                   std::string(words.data(), static_cast<std::size_t>(length)));
}

}  // namespace microslip::fem
