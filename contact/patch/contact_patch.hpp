/// @file
/// The contact points of one or several patches under a load: area weights and constants, checked.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "contact/patch.hpp"

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

}  // namespace microslip::contact
