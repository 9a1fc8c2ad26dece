/// @file
/// The BLAS that is loaded at run time: which one it is, its threads and its memory. Nothing links
/// OpenBLAS by name, so it is asked through the dynamic linker; what is asked of another BLAS does
/// nothing.
#pragma once

#include <sys/resource.h>

#include <string>

namespace microslip::fem {

/// Gives OpenBLAS two threads, one of several ranks and one where address space is scarce, whatever
/// the machine has and the environment says: with another number sums have other bits.
/// @param n_ranks_here  MPI ranks on this machine, ≥ 1.
void set_blas_threads(int n_ranks_here);

/// Too little address space (`ulimit -v`) for more than one thread of OpenBLAS.
[[nodiscard]] inline bool has_little_address_space() {
  constexpr rlim_t enough_for_threads = rlim_t{4} << 30U;  // bytes
  rlimit space{};
  return getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur < enough_for_threads;
}

/// Makes the BLAS take its working memory now. Where none is left OpenBLAS asks for it for ever:
/// better before the address space is used up than within a factorisation.
void reserve_blas_memory();

/// From here on, where cores are shared among curves and not within a matrix: the same bits for any
/// number of workers.
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

/// The BLAS and its threads, e.g. "OpenBLAS 0.3.21, 2 threads" or
/// "reference BLAS (slow: install libopenblas0-pthread)".
[[nodiscard]] std::string blas_description();

}  // namespace microslip::fem
