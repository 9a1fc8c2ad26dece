/// @file
/// Harmonic balance of a face model under the sampled law. The unknowns are the motions of all
/// nodes of the contact face alone; the structure is condensed exactly, harmonic by harmonic:
///
///   X_k = Φ_f D_k⁻¹ (f_k − Φ_fᵀ F_k(X)),   D_k = Ω² − k²ω² + 2iζΩkω,   k = 0…H                 (1)
///
/// Φ_f shapes on the face, F_k harmonics of the nodal contact forces (the mean without the preload
/// that balances the static loads, theory section 2). Complex amplitudes are Y = y_s + i y_c,
/// y = Im(Y e^{iθ}). Newton steps are solved by GMRES with exact products ∂R/∂X · δ and (1) with
/// the stiffness averaged over the period as preconditioner.
#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "tests/verification/truth/face_model.hpp"
#include "tests/verification/truth/sampled_return.hpp"

namespace microslip::truth {

struct BalanceOptions {
  int harmonics = 1;    ///< H
  int instants = 512;   ///< per period
  bool planar = false;  ///< friction along p and r; otherwise along p alone
};

class Balance {
 public:
  Balance(const FaceModel& model, const ContactConstants& contact, const BalanceOptions& options);

  [[nodiscard]] Eigen::Index n_unknowns() const { return n_face_ * n_rows_; }
  /// (1) as a residual, left minus right. @param x  n_face × (2H+1), columns y₀, s₁, c₁, …
  [[nodiscard]] Eigen::VectorXd residual(const Eigen::VectorXd& x, double omega);
  /// Derivatives at the motion of the last `residual`.
  [[nodiscard]] Eigen::VectorXd tangent(const Eigen::VectorXd& change) const;
  [[nodiscard]] Eigen::VectorXd by_omega() const;
  /// Readies and applies the preconditioner at the last `residual`.
  void prepare();
  [[nodiscard]] Eigen::VectorXd precondition(const Eigen::VectorXd& r) const;

  struct Output {
    double half_peak_to_peak = 0.0;
    double first_harmonic = 0.0;
  };
  [[nodiscard]] Output output() const;  ///< at A along x, of the last `residual` [m]
  /// Shape coordinates of the last `residual`: n_shapes × (2H+1).
  [[nodiscard]] Eigen::MatrixXd shapes() const;
  [[nodiscard]] const ContactShares& shares() const { return shares_; }
  [[nodiscard]] const BalanceOptions& options() const { return options_; }
  [[nodiscard]] const ContactConstants& contact() const { return contact_; }
  [[nodiscard]] const FaceModel& model() const { return model_; }

 private:
  [[nodiscard]] PointHistory at_points(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::MatrixXd harmonics_of(const PointHistory& tractions) const;
  [[nodiscard]] Eigen::VectorXcd compliance(int k) const;
  [[nodiscard]] Eigen::VectorXd answer(const Eigen::MatrixXd& forces, bool excited) const;
  [[nodiscard]] Eigen::MatrixXd modal_answer(const Eigen::MatrixXd& forces, bool excited) const;

  const FaceModel& model_;
  ContactConstants contact_;
  BalanceOptions options_;
  Eigen::Index n_face_;
  Eigen::Index n_rows_;
  Eigen::MatrixXd shapes_;                // n_shapes × n_face
  Eigen::MatrixXd to_time_;               // instants × (2H+1)
  Eigen::MatrixXd from_time_;             // (2H+1) × instants
  Eigen::SparseMatrix<double> to_nodes_;  // n_points × n_nodes, weights included
  double omega_ = 0.0;
  Eigen::MatrixXd static_flexibility_;  // of all shapes on the face
  PointHistory motion_;
  ContactShares shares_;
  Eigen::MatrixXd forces_;  // n_face × (2H+1)
  std::vector<Eigen::PartialPivLU<Eigen::MatrixXcd>> preconditioner_;
};

}  // namespace microslip::truth
