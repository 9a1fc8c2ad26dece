/// @file
/// The routines of LAPACK that large matrices are worth a call of: its interface,
/// not a wrapper.
#pragma once

#ifdef MICROSLIP_HAS_LAPACK
constexpr bool has_lapack = true;
extern "C" {
// NOLINTBEGIN(readability-identifier-naming): names of the library.
/// PA = LU in place, column by column. @param info  0, or the first pivot that vanishes.
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
/// Solves with the factors, or their transpose, in place.
void dgetrs_(const char* transposed, const int* n, const int* n_right, const double* a,
             const int* lda, const int* pivots, double* b, const int* ldb, int* info);
/// Eigenvalues and, on request, vectors ‖·‖ = 1 of a real matrix, which is overwritten; pairs of
/// complex vectors as real and imaginary columns. @param info  > 0: not all converged.
void dgeev_(const char* left, const char* right, const int* n, double* a, const int* lda,
            double* real, double* imaginary, double* vl, const int* ldvl, double* vr,
            const int* ldvr, double* work, const int* lwork, int* info);
/// A P = Q R in place, the largest columns first: Q as n reflectors with factors tau below R.
/// @param pivots  0 on entry: free.
void dgeqp3_(const int* m, const int* n, double* a, const int* lda, int* pivots, double* tau,
             double* work, const int* lwork, int* info);
/// Multiplies by such a Q, or its transpose, in place.
void dormqr_(const char* side, const char* transposed, const int* m, const int* n,
             const int* n_reflectors, const double* a, const int* lda, const double* tau, double* c,
             const int* ldc, double* work, const int* lwork, int* info);
// NOLINTEND(readability-identifier-naming)
}
#else  // the same names, never called
constexpr bool has_lapack = false;
template <typename... Arguments>
void dgetrf_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dgetrs_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dgeev_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dgeqp3_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dormqr_(Arguments... /*unused*/) {}
#endif
