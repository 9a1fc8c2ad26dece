/// @file
/// Where a linear response lies while the frequency passes an interval, by sums over the modes of
/// its own stiffness. With V the eigenvectors of K, A = V y, Q' = VᵀQ:
///
///   d_j y_j + Σ_k P_jk y_k = Q'_j,      d_j = λ_j − ω² + iω c_j                                (1)
///
/// λ_j and c_j are the diagonals of VᵀKV and VᵀCV; P is what is left: damping between the modes,
/// and what rounding leaves of VᵀKV and of VᵀV − I. Over the interval |d_j| ≥ δ_j, in closed form,
/// and Q'_j/d_j lies in the smallest of three discs:
///
///   about its value in the middle, radius |Q'_j| e_j/(|d_m| δ_j),   |d_j(ω) − d_m| ≤ e_j
///   about 0, radius |Q'_j|/δ_j                                                                (2)
///   about −iQ'_j/(2κ), radius |Q'_j|/(2κ), κ the least ωc_j: the image of Im d ≥ κ
///
/// Let M_jk = max|P_jk|/δ_j and s_j ≥ |Q'_j|/δ_j, s_j > 0. If t > 0 has s + M t ≤ t, then |y| ≤ t
/// over the interval (where |y_j|/t_j is largest, α say, α t_j ≤ s_j + α (t_j − s_j)), K − ω² + iωC
/// is regular there, and y is off (2) by M t at most. No inverse is formed, and an interval may be
/// as wide as the answer may be rough.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace microslip::solver {

/// A(ω) = centre + Δ + V z for all frequencies of an interval [m√kg].
struct ModalBox {
  Eigen::VectorXcd centre;  ///< sine + i cosine
  /// |z_j| at most, of the modes; 1e-10 more than that, so that V diag(reach) may be rounded, by an
  /// ulp an entry, to less than it is.
  Eigen::VectorXd reach;
  double radius = std::numeric_limits<double>::infinity();  ///< ‖Δ‖ at most: rounding
};

class ModalEnclosure {
 public:
  /// (K − ω² + iωC) A = Q.
  /// @param stiffness  K, symmetric [1/s²], n × n.
  /// @param damping    C ≥ 0, diagonal [1/s], n.
  /// @param load       Q [N/√kg], n.
  ModalEnclosure(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& damping,
                 const Eigen::VectorXcd& load);

  /// @param low, high  [rad/s], 0 < low ≤ high.
  /// @return radius infinite: nothing is proved.
  [[nodiscard]] ModalBox over(double low, double high) const;
  /// V, n × n; empty: no eigenvectors.
  [[nodiscard]] const Eigen::MatrixXd& modes() const { return V_; }
  /// min |d_j| at a frequency, about [1/s²]; 0: no eigenvectors.
  [[nodiscard]] double distance(double frequency) const;

 private:
  struct Discs;
  [[nodiscard]] Discs discs(double low, double high) const;

  Eigen::MatrixXd V_;
  Eigen::VectorXd lambda_, c_;    // diagonals
  Eigen::VectorXcd load_;         // Q̂
  Eigen::VectorXd load_error_;    // of it
  Eigen::MatrixXd of_stiffness_;  // |P| = of_stiffness + ω of_damping + ω² of_mass
  Eigen::MatrixXd of_damping_, of_mass_;
};

}  // namespace microslip::solver
