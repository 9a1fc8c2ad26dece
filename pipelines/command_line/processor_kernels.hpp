/// @file
/// The kernels of OpenBLAS that fit the processor.
#pragma once

namespace microslip::pipelines {

/// OpenBLAS knows processors by their model number and takes the kernels of 2004 (Prescott) for one
/// that is newer than itself: factorisation and eigenvectors then take twice the time. It is told
/// another choice (OPENBLAS_CORETYPE, kept for processes started from here) and chooses again;
/// where its functions for that are not to be had, the program starts itself once more, which takes
/// 0.05 s of processor time. Returns where there is nothing to do, someone has chosen, or it cannot
/// be done. To be called before any BLAS.
/// @param arguments  of main, ended by nullptr.
void use_kernels_of_processor(char** arguments);

}  // namespace microslip::pipelines
