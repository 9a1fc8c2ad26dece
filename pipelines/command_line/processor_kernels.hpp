/// @file
/// The kernels of OpenBLAS that fit the processor.
#pragma once

namespace microslip::pipelines {

/// OpenBLAS knows processors by their model number and takes the kernels of 2004 (Prescott) for one
/// that is newer than itself: factorisation and eigenvectors then take twice the time. It asks for
/// another choice (OPENBLAS_CORETYPE) only while it is loaded; so the program starts itself once
/// more with one. Returns where there is nothing to do, someone has chosen, or it cannot be done.
/// @param arguments  of main, ended by nullptr.
void start_with_kernels_of_processor(char** arguments);

}  // namespace microslip::pipelines
