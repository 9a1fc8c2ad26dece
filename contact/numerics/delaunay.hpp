/// @file
/// Delaunay triangulation of points in the plane, by insertion point after point.
///
/// Source: Bowyer, Comput. J. 24 (1981) 162–166. Signs of areas and of the in-circle determinant
/// are taken in quadruple precision on coordinates scaled to the extent of the points, so that
/// points on circles and lines, as on grids, are decided the same way every time.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace microslip::contact {

struct Triangulation {
  std::vector<std::array<int, 3>> triangles;  ///< indices, counter-clockwise
  std::vector<std::array<int, 2>> hull;       ///< edges of the boundary, inside to the left
};

/// @param points  n × 2, different from one another.
/// @return nothing but empty lists where all points lie on one line.
[[nodiscard]] Triangulation delaunay(const Eigen::MatrixX2d& points);

}  // namespace microslip::contact
