/// @file
/// Equations with ∂R/∂x = D + Tᵀ K T, solved in few unknowns (theory 14.3): with z = T y the rows
///
///   D_h y_h + T_hᵀ K z = f_h,   D_e y_e + T_eᵀ K z = f_e,   z − T_h y_h − T_e y_e = 0
///
/// lose y_h, all modes but those asked for and those at resonance. What is left are y_e and z,
/// r numbers for the N of every harmonic row.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contact/dense.hpp"
#include "solver/balance/balance_jacobian.hpp"
#include "solver/balance/newton.hpp"

namespace microslip::solver {

/// Factors of the bordered matrix, scaled:
///
///   [ ∂R/∂x s_x/s_R   ∂R/∂p s_p/s_R ]
///   [ rowᵀ                        ]
///
/// dense, or condensed where the Jacobian is known by parts.
class BorderedFactors {
 public:
  BorderedFactors(const BalanceEvaluation& at, const BranchVector& row, const Scaling& scaling);

  /// A⁻¹ B; n + 1 rows. NaN where a pivot vanishes.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;
  /// A⁻ᵀ B.
  [[nodiscard]] Eigen::MatrixXd solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& B) const;
  /// −1, 1, or 0 where a pivot vanishes.
  [[nodiscard]] double sign_of_determinant() const { return factors_.sign_of_determinant(); }

 private:
  struct Condensed {
    CondensedJacobian parts;
    PairedDiagonal inverse;  // of D_h, over the scale
    double scale;            // s_x/s_R
    Eigen::VectorXd by_parameter;
    BranchVector row;
    Eigen::VectorXd of_rows;  // that rows of the few unknowns were divided by
  };
  static contact::LuFactors factorised(const BalanceEvaluation& at, const BranchVector& row,
                                       const Scaling& scaling, std::optional<Condensed>& condensed);

  std::optional<Condensed> condensed_;
  contact::LuFactors factors_;  // of all unknowns, or of the few
};

/// One step of Newton's method along the plane of `row`, a scaled direction: x and parameter change
/// by it. NaN where a pivot vanishes.
[[nodiscard]] BranchVector newton_step(const BalanceEvaluation& at, const BranchVector& row,
                                       const Scaling& scaling);

/// A⁻¹ b. NaN where a pivot vanishes.
[[nodiscard]] Eigen::VectorXd solved(const BalanceJacobian& jacobian, const Eigen::VectorXd& b);
/// −1, 1, or 0 where a pivot vanishes.
[[nodiscard]] double sign_of_determinant(const BalanceJacobian& jacobian);

/// J_ll − J_lh J_hh⁻¹ J_hl: what is left of a balance where the unknowns h follow.
/// @param low  unknowns that stay, ascending.
[[nodiscard]] Eigen::MatrixXd schur_complement(const BalanceJacobian& jacobian,
                                               const std::vector<Eigen::Index>& low);

}  // namespace microslip::solver
