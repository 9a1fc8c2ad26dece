/// @file
/// Convex hull of points of a plane, and how far a point is from its edge.
#pragma once

#include <Eigen/Core>

namespace microslip::contact {

/// Hull of a cloud of points; a segment or one point if they lie on a line or together.
class PlaneHull {
 public:
  /// @param points  2 × n, n ≥ 1, finite. Corners that stand out by less than 1e-13 of the extent
  ///                are dropped: rounding of points on one line.
  explicit PlaneHull(const Eigen::Ref<const Eigen::Matrix2Xd>& points);

  /// Corners counterclockwise, 2 × n_corners: 1 a point, 2 a segment.
  [[nodiscard]] const Eigen::Matrix2Xd& corners() const { return corners_; }
  /// Largest distance of a corner from the mean of the corners.
  [[nodiscard]] double radius() const { return radius_; }
  /// Distance to the hull, above 0 outside; below 0 inside, the distance to the nearest edge. In a
  /// segment "inside" means on its line within rounding (1e-12 of the extent), between its ends; a
  /// single point is inside itself within rounding.
  [[nodiscard]] double signed_distance(const Eigen::Vector2d& point) const;
  /// Largest t with t · direction inside a hull around the origin; NaN if the origin lies outside
  /// or on its edge, or the hull has no area; ∞ for the direction 0.
  [[nodiscard]] double reach(const Eigen::Vector2d& direction) const;

 private:
  [[nodiscard]] double distance_of_line(const Eigen::Vector2d& point) const;
  /// Outward normal of the edge that starts at corner i.
  [[nodiscard]] Eigen::Vector2d normal(Eigen::Index i) const;
  [[nodiscard]] Eigen::Vector2d corner_after(Eigen::Index i) const;

  Eigen::Matrix2Xd corners_;
  double radius_ = 0.0;
};

}  // namespace microslip::contact
