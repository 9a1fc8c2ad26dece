/// @file
/// The BLAS that is loaded at run time: which one it is, and its threads. Nothing links OpenBLAS by
/// name, so it is asked through the dynamic linker.
#pragma once

namespace microslip::fem {

/// Gives OpenBLAS the hardware threads this process may use, shared among the ranks on this
/// machine. A positive OPENBLAS_NUM_THREADS or OMP_NUM_THREADS of the user is left in force.
/// Does nothing for another BLAS.
/// @param n_ranks_here  MPI ranks on this machine, ≥ 1.
void set_blas_threads(int n_ranks_here);

/// Makes the BLAS take its working memory now. Where none is left OpenBLAS asks for it for ever:
/// better before the address space is used up than within a factorisation.
void reserve_blas_memory();

}  // namespace microslip::fem
