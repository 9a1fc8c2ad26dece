/// @file
/// Decompositions of dense matrices, compiled once: a header of Eigen's costs every file that
/// includes it seconds, its code megabytes. The lowest room that needs them has them;
/// the others use its face.
///
/// Matrices are square unless said otherwise; numbers that are not finite go through, as in Eigen.
#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <optional>

#include <Eigen/Core>

namespace microslip::contact {

/// PA = LU with partial pivoting.
class LuFactors {
 public:
  explicit LuFactors(const Eigen::MatrixXd& A);
  ~LuFactors();
  LuFactors(LuFactors&&) noexcept;
  LuFactors& operator=(LuFactors&&) noexcept;
  LuFactors(const LuFactors&) = delete;
  LuFactors& operator=(const LuFactors&) = delete;

  /// A⁻¹ B, any number of columns; NaN where a pivot vanishes.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;
  /// A⁻ᵀ B.
  [[nodiscard]] Eigen::MatrixXd solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& B) const;
  /// −1, 1, or 0 where a pivot vanishes.
  [[nodiscard]] double sign_of_determinant() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// A⁻¹ B by one factorisation that is not kept.
[[nodiscard]] Eigen::MatrixXd solved(const Eigen::MatrixXd& A,
                                     const Eigen::Ref<const Eigen::MatrixXd>& B);
[[nodiscard]] Eigen::MatrixXcd solved(const Eigen::MatrixXcd& A,
                                      const Eigen::Ref<const Eigen::MatrixXcd>& B);
/// Empty: a pivot vanishes.
[[nodiscard]] std::optional<Eigen::MatrixXd> inverted(const Eigen::MatrixXd& A);
[[nodiscard]] std::optional<Eigen::MatrixXcd> inverted(const Eigen::MatrixXcd& A);

/// Dimension of the kernel to rounding, by complete pivoting.
[[nodiscard]] Eigen::Index nullity(const Eigen::MatrixXd& A);

/// The one direction y, ‖y‖ = 1, with A y = 0.
/// @param A  n × (n + 1).   @return none: the rank is below n.
[[nodiscard]] std::optional<Eigen::VectorXd> null_direction(const Eigen::MatrixXd& A);

/// Pairs of a symmetric matrix, or of a pencil K φ = λ M φ with ΦᵀMΦ = I.
struct SymmetricPairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< columns
};
/// Ascending; the lower triangle is read. @return none: they do not converge.
[[nodiscard]] std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A);
[[nodiscard]] std::optional<SymmetricPairs> symmetric_pairs(const Eigen::MatrixXd& A);
[[nodiscard]] std::optional<SymmetricPairs> symmetric_pairs(const Eigen::MatrixXd& K,
                                                            const Eigen::MatrixXd& M);
/// By Cholesky's factorisation.
[[nodiscard]] bool is_positive_definite(const Eigen::MatrixXd& A);

struct GeneralPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< columns, ‖·‖ = 1
};
/// Of any real matrix. @return none: they do not converge.
[[nodiscard]] std::optional<Eigen::VectorXcd> general_eigenvalues(const Eigen::MatrixXd& A);
[[nodiscard]] std::optional<GeneralPairs> general_pairs(const Eigen::MatrixXd& A);
/// All values, and the vectors of those that are wanted, for a fraction of the time of all.
/// @param wanted  asked of values with imaginary part ≥ 0; holds for their conjugates as well.
/// @return        columns of others are 0; none: something did not converge.
[[nodiscard]] std::optional<GeneralPairs> general_pairs(
    const Eigen::MatrixXd& A, const std::function<bool(std::complex<double>)>& wanted);

/// e^A by scaling and squaring of Padé's approximant (Higham, SIAM J. Matrix Anal. Appl.
/// 26 (2005) 1179–1193).
/// @param A  finite.
[[nodiscard]] Eigen::MatrixXd exponential(const Eigen::MatrixXd& A);

}  // namespace microslip::contact
