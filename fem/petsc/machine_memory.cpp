#include "fem/petsc/machine_memory.hpp"

#include <petscsys.h>

#include <fstream>
#include <limits>
#include <string>

#include "fem/petsc_error.hpp"

namespace microslip::fem {
namespace {

double available_here_mb() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  double kilobytes = 0.0;
  std::string rest;
  while (file >> key >> kilobytes && std::getline(file, rest)) {
    if (key == "MemAvailable:") return kilobytes / 1000.0 * 1.024;
  }
  return std::numeric_limits<double>::infinity();
}

int ranks_here() {
  MPI_Comm here = MPI_COMM_NULL;
  int n = 1;
  check(MPI_Comm_split_type(PETSC_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here));
  check(MPI_Comm_size(here, &n));
  check(MPI_Comm_free(&here));
  return n;
}

}  // namespace

double available_memory_mb() {
  const double share = available_here_mb() / ranks_here();
  double total = 0.0;
  check(MPI_Allreduce(&share, &total, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  return total;
}

}  // namespace microslip::fem
