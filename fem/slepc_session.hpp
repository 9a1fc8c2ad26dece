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

/// From here on, where cores are shared among curves and not within a matrix: the same bits for any
/// number of workers. Does nothing for a BLAS other than OpenBLAS.
void use_one_blas_thread();

/// While it stands OpenBLAS has one thread: where matrices are small, others only wait.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
  OneBlasThread(OneBlasThread&&) = delete;
  OneBlasThread& operator=(OneBlasThread&&) = delete;

 private:
  int n_threads_ = 0;  ///< before; 0: another BLAS
};

/// The BLAS loaded at run time and its threads, e.g. "OpenBLAS 0.3.21, 2 threads" or
/// "reference BLAS (slow: install libopenblas0-pthread)".
[[nodiscard]] std::string blas_description();
/// Name and version of PETSc, SLEPc, MUMPS and MPI; before a session as well.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace microslip::fem
