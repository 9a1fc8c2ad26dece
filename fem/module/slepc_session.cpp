#include "fem/slepc_session.hpp"

#include <sys/mman.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include <mpi.h>
#include <petscpkg_version.h>
#include <petscversion.h>
#include <slepcversion.h>

#include "fem/blas_threads.hpp"
#include "fem/module/fem_module.hpp"
#include "fem/petsc_error.hpp"
#include "fem/process/mpi_error.hpp"
#include "fem/ranks.hpp"

namespace microslip::fem {

namespace {

enum class Phase : std::uint8_t { before, open, over };
Phase phase = Phase::before;

/// MPI ends the process, and OpenBLAS never returns, where the address space is limited to less
/// than they take (`ulimit -v`).
void require_address_space() {
  constexpr std::size_t needed =
      450'000'000;  // MPI, its threads, a buffer of OpenBLAS: some 350 MB
  void* space =
      mmap(nullptr, needed, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (space == MAP_FAILED) {
    throw MemoryError(
        "less than " + std::to_string(needed / 1'000'000) +
        " MB of address space are left, which finite elements need to start; raise the limit "
        "(ulimit -v)");
  }
  munmap(space, needed);
}

/// A single process starts no others, and looks for no network: without the first setting, Open MPI
/// looks for ssh in PATH and ends where there is none; without the second it starts a daemon;
/// without the third it waits 0.2 s for network cards. What the user set stays.
void stay_alone() {
  setenv("OMPI_MCA_plm", "isolated", 0);
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
}

}  // namespace

SlepcSession::SlepcSession() {
  if (phase != Phase::before) {
    throw std::logic_error("SlepcSession: one per process, and there was one already");
  }
  require_address_space();
  // Ranks that wait for each other leave the core to those that work, where others use the machine
  // as well.
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  if (!started_in_parallel()) stay_alone();
  know_ranks_here(fem_module().open());
  set_blas_threads(n_ranks_here());
  reserve_blas_memory();
  phase = Phase::open;
}

SlepcSession::~SlepcSession() {
  fem_module().close();
  phase = Phase::over;
}

bool SlepcSession::is_open() { return phase == Phase::open; }

std::vector<std::pair<std::string, std::string>> library_versions() {
  const auto dotted = [](int a, int b, int c) {
    return std::to_string(a) + '.' + std::to_string(b) + '.' + std::to_string(c);
  };
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> mpi{};
  int length = 0;
  check_mpi(MPI_Get_library_version(mpi.data(), &length));
  const std::string name(mpi.data(), static_cast<std::size_t>(length));
  return {{"PETSc", dotted(PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR)},
          {"SLEPc", dotted(SLEPC_VERSION_MAJOR, SLEPC_VERSION_MINOR, SLEPC_VERSION_SUBMINOR)},
          {"MUMPS", dotted(PETSC_PKG_MUMPS_VERSION_MAJOR, PETSC_PKG_MUMPS_VERSION_MINOR,
                           PETSC_PKG_MUMPS_VERSION_SUBMINOR)},
          {"MPI", name.substr(0, name.find(','))}};
}

}  // namespace microslip::fem
