/// @file
/// A plane contact area under the six relative coordinates of its centre: motion of its cells.
///
/// Letters of paper B: x normal, y and z tangential, (x, y, z) = (q, r, p) of the patches, body 2 =
/// A, body 1 = B. With the relative motion U = U⁽²⁾ − U⁽¹⁾ = (u, v, w, φ_x, φ_y, φ_z) of the centre
/// and cell i at (0, y_i, z_i)
///
///   u_i = G_i U,     G_i = [1 0 0 0 z_i −y_i ; 0 1 0 −z_i 0 0 ; 0 0 1 y_i 0 0]       (1) [B-eq 7]
///   (F, M) = Σ w_i G_iᵀ t_i,     t_i = (n, f_r, f_p)_i                             (2) [B-eq 8]
///
/// so M_x = Σ w (y f_p − z f_r), M_y = Σ w z n, M_z = −Σ w y n: M_y turns about r, M_z about p. The
/// resultant resists U: on the left side of the equations of motion node 2 gets F − F₀, node 1 the
/// opposite [B-eq 11]. One matrix for motion and force: virtual work is the same in cells and at
/// the centre.
///
/// Source: paper B, section 2.3, eqs 6–8, 11; theory section 12.
#pragma once

#include <Eigen/Core>

#include "contact/patch.hpp"

namespace microslip::contact {

/// Points of a plane with their weights, in any order.
struct PlanarCells {
  Eigen::VectorXd y;        ///< along r [m], n
  Eigen::VectorXd z;        ///< along p [m], n
  Eigen::VectorXd weights;  ///< area [m²], or 1 for cells whose constants are their own [-], n, ≥ 0
};

/// Centres of n × m equal cells of a rectangle around the origin, z fastest;
/// weights are their areas.
/// @param height  h along y [m], > 0.   @param breadth  b along z [m], > 0.
/// @param n_along_y, n_along_z  n, m ≥ 1.
/// @throws std::invalid_argument  out of range.
[[nodiscard]] PlanarCells rectangle_cells(double height, double breadth, int n_along_y,
                                          int n_along_z);

using CellMatrix = Eigen::Matrix<double, 3, 6>;  ///< G_i of (1)

/// G_i of (1) for a cell at (y, z) [m].
[[nodiscard]] CellMatrix cell_matrix(double y, double z);

class ContactArea {
 public:
  /// @throws std::invalid_argument  sizes differ, no cell with weight, a value not finite, a weight
  ///         negative; names the cell (from 1).
  explicit ContactArea(PlanarCells cells);

  [[nodiscard]] Eigen::Index n_cells() const { return cells_.weights.size(); }
  [[nodiscard]] const PlanarCells& cells() const { return cells_; }

  /// Relative mode shapes of the cells from those of the centre, in the letters of the patches.
  /// @param modes  U of each mode [1/√kg, 1/(m√kg)], 6 × n_modes.
  [[nodiscard]] ModalShapes modal_shapes(const Eigen::Ref<const Eigen::MatrixXd>& modes) const;

 private:
  PlanarCells cells_;
};

}  // namespace microslip::contact
