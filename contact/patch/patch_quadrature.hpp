/// @file
/// Quadrature on a planar patch given as cells, triangles and convex quadrilaterals in patch coordinates
/// (p, r): holes, notches and separate pieces are simply where no cell is (theory section 13).
///
/// Both kinds are one bilinear map of the square [−1, 1]²; a triangle has its first corner twice, so
/// that one edge of the square collapses into it:
///
///   x(ξ, η) = c + a ξ + b η + d ξη,      |∂x/∂(ξ, η)| = |a×b + ξ a×d + η d×b|                    (1)
///
/// (1) is linear: two Gauss points per direction integrate the area exactly, and so does every rule here.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace microslip::contact {

/// Cells of a patch. Neighbours may or may not share vertices; nothing here needs to know.
struct PatchCells {
  Eigen::MatrixX2d vertices;  ///< (p, r) [m]
  Eigen::MatrixX4i corners;  ///< vertex indices in order around the cell; triangles: the last is −1
};

/// Points and weights: what a ContactPatch needs besides the law.
struct PatchRule {
  Eigen::VectorXd p;                 ///< [m], n
  Eigen::VectorXd r;                 ///< [m], n
  Eigen::VectorXd weights;           ///< [m²], n, > 0; the sum is the area of the cells
  Eigen::Index n_dropped_cells = 0;  ///< cells without area

  [[nodiscard]] Eigen::Index n_points() const { return weights.size(); }
};

/// (1) for one cell.
class PatchCell {
 public:
  explicit PatchCell(const std::array<Eigen::Vector2d, 4>& corners);

  [[nodiscard]] Eigen::Vector2d at(double xi, double eta) const {
    return centre_ + by_xi_ * xi + by_eta_ * eta + by_both_ * (xi * eta);
  }
  /// Area of the patch per area of the square, ≥ 0.
  [[nodiscard]] double density(double xi, double eta) const;
  [[nodiscard]] double area() const { return 4.0 * density(0.0, 0.0); }
  /// Largest distance between two corners, squared.
  [[nodiscard]] double size_squared() const { return size_squared_; }
  /// Smallest density over the corners, negative where the cell is not convex.
  [[nodiscard]] double smallest_density() const;

 private:
  Eigen::Vector2d centre_, by_xi_, by_eta_, by_both_;
  double density_, density_by_xi_, density_by_eta_;
  double size_squared_;
};

/// The cells of a patch, those without area left out.
/// @throws std::invalid_argument  an index out of range, a coordinate that is not finite, a quadrilateral
///         that is not convex (each names the cell, from 1), or no cell with area.
[[nodiscard]] std::vector<PatchCell> patch_cells(const PatchCells& cells);

/// One point per cell, at its centroid: exact for linear functions.
[[nodiscard]] PatchRule midpoint_rule(const PatchCells& cells);

/// order × order Gauss points per cell: on parallelograms exact for polynomials of degree 2 order − 1
/// in each direction.
/// @throws std::invalid_argument  order < 1; otherwise as patch_cells().
[[nodiscard]] PatchRule gauss_rule(const PatchCells& cells, int order);

/// A rectangle [p_begin, p_end] × [r_begin, r_end] as n_p × n_r cells.
/// @throws std::invalid_argument  n_p or n_r < 1.
[[nodiscard]] PatchCells rectangle_cells(const Eigen::Vector2d& begin, const Eigen::Vector2d& end,
                                         int n_p, int n_r);

}  // namespace microslip::contact
