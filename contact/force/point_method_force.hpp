/// @file
/// Modal force of a friction patch whose points are evaluated by any method (point_method.hpp), for
/// any number of harmonics and both tangential directions (theory section 13):
///
///   ∂G/∂q = Σ_i w_i Φ_iᵀ J_i Φ_i,      J_i the Jacobian of the point
///
/// PatchForce does the same faster where the closed form of one harmonic and one direction is
/// enough.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contact/force/pointwise_force.hpp"
#include "contact/patch.hpp"
#include "contact/point/point_method.hpp"

namespace microslip::contact {

class PointMethodForce final : public PointwiseForce {
 public:
  /// @param weights  area of each point [m²], n ≥ 1, ≥ 0.
  /// @param methods     one per point, n; shared by patches of one scene.
  /// @param shapes   relative mode shapes at the points, n × n_modes;
  ///                 w may be empty (no motion along r).
  /// @throws std::invalid_argument  sizes differ or a value is not finite.
  PointMethodForce(Eigen::VectorXd weights, std::vector<std::shared_ptr<const PointMethod>> methods,
                   ModalShapes shapes);

 private:
  /// Points cost what all harmonics of the motion do, their sum over the patch what the rows do.
  [[nodiscard]] ForceAndJacobian awake_force(double frequency, const Asked& asked,
                                             PointwiseWork& work) const override;
  void find_states(double frequency, PointwiseWork& work) const override;
  [[nodiscard]] ForceAndJacobian wider_force(double frequency, int n_harmonics,
                                             const PointwiseWork& work) const;
  void add_cycles(std::span<const Eigen::Index> points, double frequency, PointwiseWork& work,
                  ReportSum& sum) const override;

  [[nodiscard]] WorkPrecision work_precision(Eigen::Index point,
                                             int /*n_harmonics*/) const override {
    return {.friction = methods_[static_cast<std::size_t>(point)]->work_precision()};
  }

  std::vector<std::shared_ptr<const PointMethod>> methods_;
  std::vector<const Eigen::MatrixXd*> shape_;  // of u, v and, unless empty, w
};

}  // namespace microslip::contact
