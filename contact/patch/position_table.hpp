/// @file
/// A quantity given at points of a patch, anywhere else by interpolation.
///
/// Points that fill a grid of the axes p and r are interpolated bilinearly, others linearly on
/// their Delaunay triangulation. Both are continuous, hit every value given, reproduce linear
/// fields and never leave the range of the values. Outside, the value at the nearest place inside
/// counts (of the grid's rectangle, of the convex hull).
/// Points on one line are interpolated along it.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace microslip::contact {

class PositionTable {
 public:
  /// @param p, r    positions [m], n ≥ 1.   @param values  there, n, any unit.
  /// @throws std::invalid_argument  sizes differ, a number is not finite, or a position is given
  ///         twice (names both rows, from 1).
  /// @note O(n²) for n scattered points; a grid costs nothing.
  PositionTable(Eigen::VectorXd p, Eigen::VectorXd r, Eigen::VectorXd values);

  /// Of the positions, p before r [m].
  [[nodiscard]] Eigen::AlignedBox2d box() const;

  /// n values at any positions.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& p, const Eigen::VectorXd& r) const;

 private:
  enum class Kind { grid, line, scattered };
  [[nodiscard]] bool set_grid();
  [[nodiscard]] double on_grid(double p, double r) const;
  [[nodiscard]] double on_edges(double p, double r) const;
  [[nodiscard]] double on_triangles(double p, double r) const;

  Eigen::VectorXd p_, r_, values_;
  Kind kind_ = Kind::scattered;
  std::vector<double> grid_p_, grid_r_;        // ascending
  Eigen::MatrixXd grid_;                       // values, p by r
  std::vector<std::array<int, 3>> triangles_;  // counter-clockwise
  std::vector<std::array<int, 2>> edges_;      // of the hull, or along the line
};

}  // namespace microslip::contact
