#include "fem/module/fem_module.hpp"

#include <cstdlib>
#include <optional>
#include <string>
#include <type_traits>

#include <slepcsys.h>

#include "fem/eigen/assembled_structure.hpp"
#include "fem/petsc/petsc_check.hpp"
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

int open() {
  PETSC_MPI_THREAD_REQUIRED = MPI_THREAD_SERIALIZED;  // for rank_messages.hpp
  {
    const QuietOptions quiet;
    check(SlepcInitialize(nullptr, nullptr, nullptr, nullptr));
  }
  install_error_handler();
  meet_ranks();
  return n_ranks_here();
}

void close() {
  PetscPopErrorHandler();
  SlepcFinalize();
}

}  // namespace

const FemModule& linked_fem_module() {
  static constexpr FemModule module{MICROSLIP_FEM_HEADERS, &open, &close, &assembled_structure,
                                    &given_structure};
  return module;
}

}  // namespace microslip::fem
