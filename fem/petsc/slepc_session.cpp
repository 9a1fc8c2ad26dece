#include "fem/slepc_session.hpp"

#include <sys/mman.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include <petscpkg_version.h>
#include <slepcsys.h>

#include "fem/petsc/blas_library.hpp"
#include "fem/petsc_error.hpp"
#include "fem/ranks.hpp"

namespace microslip::fem {

static_assert(std::is_same_v<PetscScalar, double>, "PETSc must be built with real double scalars");

namespace {

// PETSc reads PETSC_OPTIONS and ~/.petscrc while it starts; a stray option there must not change
// results, so both are kept from it.
class QuietOptions {
 public:
  QuietOptions() {
    if (const char* value = std::getenv(name)) before_ = value;
    setenv(name, "-skip_petscrc -no_signal_handler", 1);
  }
  ~QuietOptions() {
    if (before_) {
      setenv(name, before_->c_str(), 1);
    } else {
      unsetenv(name);
    }
  }
  QuietOptions(const QuietOptions&) = delete;
  QuietOptions& operator=(const QuietOptions&) = delete;
  QuietOptions(QuietOptions&&) = delete;
  QuietOptions& operator=(QuietOptions&&) = delete;

 private:
  static constexpr const char* name = "PETSC_OPTIONS";
  std::optional<std::string> before_;
};

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
  int over = 0;
  check(MPI_Finalized(&over));
  if (over != 0 || is_open()) {
    throw std::logic_error("SlepcSession: one per process, and there was one already");
  }
  require_address_space();
  // Ranks that wait for each other leave the core to those that work, where others use the machine
  // as well.
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  if (!started_in_parallel()) stay_alone();
  PETSC_MPI_THREAD_REQUIRED = MPI_THREAD_SERIALIZED;  // for rank_messages.hpp
  {
    const QuietOptions quiet;
    check(SlepcInitialize(nullptr, nullptr, nullptr, nullptr));
  }
  install_error_handler();
  meet_ranks();
  set_blas_threads(n_ranks_here());
  reserve_blas_memory();
}

SlepcSession::~SlepcSession() {
  PetscPopErrorHandler();
  SlepcFinalize();
}

bool SlepcSession::is_open() {
  PetscBool open = PETSC_FALSE;
  check(SlepcInitialized(&open));
  return open == PETSC_TRUE;
}

std::vector<std::pair<std::string, std::string>> library_versions() {
  const auto dotted = [](int a, int b, int c) {
    return std::to_string(a) + '.' + std::to_string(b) + '.' + std::to_string(c);
  };
  const auto of = [&](PetscErrorCode (*get)(PetscInt*, PetscInt*, PetscInt*, PetscInt*)) {
    PetscInt major = 0;
    PetscInt minor = 0;
    PetscInt patch = 0;
    check(get(&major, &minor, &patch, nullptr));
    return dotted(major, minor, patch);
  };
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> mpi{};
  int length = 0;
  check(MPI_Get_library_version(mpi.data(), &length));
  const std::string name(mpi.data(), static_cast<std::size_t>(length));
  return {{"PETSc", of(&PetscGetVersionNumber)},
          {"SLEPc", of(&SlepcGetVersionNumber)},
          {"MUMPS", dotted(PETSC_PKG_MUMPS_VERSION_MAJOR, PETSC_PKG_MUMPS_VERSION_MINOR,
                           PETSC_PKG_MUMPS_VERSION_SUBMINOR)},
          {"MPI", name.substr(0, name.find(','))}};
}

}  // namespace microslip::fem
