/// @file
/// A contact patch as the contact room knows it: points with area weights in a frame (p, q, r),
/// local constants of every point, and the relative mode shapes there. Plain arrays; where they come
/// from (finite elements, another code, a formula) is not known here.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/surface/point_parameters.hpp"

namespace microslip::contact {

/// Everything about the points but their motion. Complete and checked when constructed.
class ContactPatch {
 public:
  /// @param weights  area of each point [m²] (or 1 for lumped points), n ≥ 1, ≥ 0.
  /// @param points   constants, n.
  /// @throws std::invalid_argument  sizes differ, NaN, or a value out of its range; names the
  ///         quantity, the point (from 1) and the value.
  ContactPatch(Eigen::VectorXd weights, std::vector<PointParameters> points);

  [[nodiscard]] Eigen::Index n_points() const { return weights_.size(); }
  [[nodiscard]] const Eigen::VectorXd& weights() const { return weights_; }
  [[nodiscard]] const std::vector<PointParameters>& points() const { return points_; }

 private:
  Eigen::VectorXd weights_;
  std::vector<PointParameters> points_;
};

/// Relative mode shapes (A minus B) at points of a patch in its frame, each n_points × n_modes
/// [1/√kg]: u along p, v along q (positive approach), w along r. `w` may be empty (no motion).
struct ModalShapes {
  Eigen::MatrixXd u;
  Eigen::MatrixXd v;
  Eigen::MatrixXd w;
};

}  // namespace microslip::contact
