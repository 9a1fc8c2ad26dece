/// @file
/// ∂R/∂x of the balance: a dense matrix, or where contact sees the N modes through r coordinates
/// (theory 14.2) its parts
///
///   ∂R/∂x = D + Tᵀ K T,   D: of every mode and harmonic alone, T the same for every harmonic row
///
/// by which equations are solved in r coordinates (theory 14.3, condensed.hpp).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contact/modal_force.hpp"

namespace microslip::solver {

/// D over mean, sine 1, cosine 1, sine 2 …, each a block of N modes, or without the mean: a
/// diagonal, and between the sine and the cosine of a harmonic another. Its inverse and its
/// transpose are of the same kind.
struct PairedDiagonal {
  Eigen::Index n_modes = 0;
  Eigen::Index orders_begin = 0;  ///< the first sine
  Eigen::VectorXd diagonal;       ///< n
  Eigen::VectorXd coupling;       ///< n; of a sine: with its cosine, of a cosine: with its sine

  /// D B; n rows.
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::MatrixXd& B) const;
  void add_to(Eigen::MatrixXd& matrix) const;
  [[nodiscard]] PairedDiagonal transposed() const;
  /// Zero at the rows named, a sine together with its cosine.
  [[nodiscard]] PairedDiagonal inverse_without(const std::vector<Eigen::Index>& rows) const;
};

/// The parts, n = rows · N unknowns.
struct CondensedJacobian {
  PairedDiagonal own;                                        ///< D [1/s²]
  std::shared_ptr<const contact::FewerDerivatives> contact;  ///< T and K, rows · r
  /// Unknowns, ascending, whose own stiffness nearly vanishes, at a resonance: not to be divided
  /// by.
  std::vector<Eigen::Index> resonant;
};

class BalanceJacobian {
 public:
  BalanceJacobian() = default;
  template <typename Derived>
  BalanceJacobian(const Eigen::MatrixBase<Derived>& dense)  // NOLINT(google-explicit-constructor)
      : dense_(dense) {}
  BalanceJacobian(Eigen::MatrixXd&& dense)  // NOLINT(google-explicit-constructor)
      : dense_(std::move(dense)) {}
  explicit BalanceJacobian(CondensedJacobian parts)
      : parts_(std::make_shared<const CondensedJacobian>(std::move(parts))) {}

  [[nodiscard]] bool empty() const { return !parts_ && dense_.size() == 0; }
  [[nodiscard]] bool all_finite() const;
  /// nullptr: dense.
  [[nodiscard]] const CondensedJacobian* parts() const { return parts_.get(); }
  /// n × n; of parts made when asked for first, for one thread at a time.
  [[nodiscard]] const Eigen::MatrixXd& dense() const;

 private:
  std::shared_ptr<const CondensedJacobian> parts_;
  mutable Eigen::MatrixXd dense_;
};

}  // namespace microslip::solver
