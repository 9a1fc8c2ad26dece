/// @file
/// Opens and closes PETSc, SLEPc and MPI; `main` makes it first, so that it dies last.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace microslip::fem {

class SlepcSession {
 public:
  /// On several MPI ranks (fem/ranks.hpp): each has its share of the cores for BLAS, and rank 0,
  /// which does alone what is not solved on all, may use the cores of all that are on its machine.
  /// Does not read the command line. PETSc's own error handler and signal handler are switched off.
  /// @throws std::logic_error  a second one in the life of the process.
  /// @throws MemoryError       the address space is limited to less than the libraries need to
  ///         start.
  SlepcSession();
  ~SlepcSession();
  SlepcSession(const SlepcSession&) = delete;
  SlepcSession& operator=(const SlepcSession&) = delete;
  SlepcSession(SlepcSession&&) = delete;
  SlepcSession& operator=(SlepcSession&&) = delete;

  [[nodiscard]] static bool is_open();
};

/// Name and version of PETSc, SLEPc, MUMPS and MPI; before a session as well.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace microslip::fem
