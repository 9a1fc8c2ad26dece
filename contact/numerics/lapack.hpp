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
/// Scales rows and columns alike, `job` = "S". @param low, high  of what is to be reduced.
void dgebal_(const char* job, const int* n, double* a, const int* lda, int* low, int* high,
             double* scale, int* info);
/// Vectors of what was scaled, in place.
void dgebak_(const char* job, const char* side, const int* n, const int* low, const int* high,
             const double* scale, const int* m, double* v, const int* ldv, int* info);
/// A = Q H Qᵀ in place, H upper Hessenberg, below it the reflectors of Q with factors tau.
void dgehrd_(const int* n, const int* low, const int* high, double* a, const int* lda, double* tau,
             double* work, const int* lwork, int* info);
/// Multiplies by such a Q, in place.
void dormhr_(const char* side, const char* transposed, const int* m, const int* n, const int* low,
             const int* high, const double* a, const int* lda, const double* tau, double* c,
             const int* ldc, double* work, const int* lwork, int* info);
/// Eigenvalues of H, which is overwritten, by single double-shift sweeps.
void dlahqr_(const int* wants_form, const int* wants_vectors, const int* n, const int* low,
             const int* high, double* h, const int* ldh, double* real, double* imaginary,
             const int* first, const int* last, double* z, const int* ldz, int* info);
/// Vectors of H for values chosen, by inverse iteration; of pairs as real and imaginary columns.
void dhsein_(const char* side, const char* source, const char* start, int* chosen, const int* n,
             const double* h, const int* ldh, double* real, const double* imaginary, double* vl,
             const int* ldvl, double* vr, const int* ldvr, const int* most, int* m, double* work,
             int* failed_left, int* failed_right, int* info);
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
template <typename... Arguments>
void dgebal_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dgebak_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dgehrd_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dormhr_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dlahqr_(Arguments... /*unused*/) {}
template <typename... Arguments>
void dhsein_(Arguments... /*unused*/) {}
#endif
