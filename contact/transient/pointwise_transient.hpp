/// @file
/// A friction patch in time as a sum over points: what is the same whatever law they obey.
#pragma once

#include <Eigen/Core>

#include "contact/patch.hpp"
#include "contact/transient_force.hpp"

namespace microslip::contact {

class PointwiseTransient : public TransientForce {
 public:
  [[nodiscard]] Eigen::Index n_modes() const final { return shapes_.u.cols(); }
  [[nodiscard]] Eigen::Index n_points() const final { return weights_.size(); }
  [[nodiscard]] TransientMemory virgin_memory() const final;
  /// All 0 without area.
  [[nodiscard]] StateShares shares(const TransientMemory& memory) const final;

 protected:
  /// @param weights     area of each point [m²], n_points.
  /// @param shapes      relative mode shapes at the points, n_points × n_modes.
  /// @param directions  of the slider of a point, 1 or 2.
  PointwiseTransient(Eigen::VectorXd weights, ModalShapes shapes, int directions);

  [[nodiscard]] const Eigen::VectorXd& weights() const { return weights_; }
  [[nodiscard]] const ModalShapes& shapes() const { return shapes_; }

 private:
  Eigen::VectorXd weights_;
  ModalShapes shapes_;
  int directions_;
};

}  // namespace microslip::contact
