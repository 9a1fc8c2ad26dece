/// @file
/// Sum over the points of a patch of what their methods give,
/// projected on the modes (theory section 13):
///
///   G^(k) = Σ_i w_i Σ_s φ_si (f_si − n_ref,i δ_s1 δ_k0)^(k),   ∂G/∂q = Σ_i w_i Φ_iᵀ J_i Φ_i
///
/// and ∂G/∂ω, with the signals s: u, v and, where the patch moves along r, w. Points are taken in
/// blocks; Φᵀ (J Φ) of a block are dense products (projection_kernels.hpp).
/// Storage is kept from one sum to the next.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/force/projection_kernels.hpp"
#include "contact/modal_force.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {

class PointProjection {
 public:
  /// @param shapes  n_points × n_modes of each signal, u and v at least; borrowed until take().
  /// @param rows    harmonic rows of the derivatives, ascending.
  void start(const std::vector<const Eigen::MatrixXd*>& shapes, int n_harmonics,
             const std::vector<Eigen::Index>& rows);
  void add(Eigen::Index point, double weight, double reference_load, const PointTraction& traction);
  [[nodiscard]] ForceAndJacobian take();

 private:
  void gather(double weight, const Eigen::MatrixXd& jacobian);
  void add_forces(double weight, double reference_load, const PointTraction& traction);
  void flush();
  [[nodiscard]] double* phi(std::size_t row) { return phi_.data() + row * size_.phi_stride; }

  const std::vector<const Eigen::MatrixXd*>* shapes_ = nullptr;
  std::vector<Eigen::Index> rows_;
  ProjectionSizes size_;
  std::size_t n_all_ = 0;      // harmonic rows of the forces
  std::size_t n_waiting_ = 0;  // rows of the block: points × signals
  bool any_jacobian_ = false;  // in the block
  bool depends_on_frequency_ = false;
  double defect_ = 0.0;
  std::vector<double> phi_;    // [row of the block][mode]
  std::vector<double> force_;  // [row of the block][harmonic row], weighted
  std::vector<double> by_frequency_;
  std::vector<double> coefficients_;  // weighted Jacobian of a point as `spread` reads it
  std::vector<double> spread_;
  std::vector<double> jacobian_;  // [harmonic row][mode][stride]
  Harmonics force_sum_;
  Harmonics by_frequency_sum_;
};

}  // namespace microslip::contact
