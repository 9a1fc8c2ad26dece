/// @file
/// Quadrature on reference elements: tetrahedra on the unit simplex (weights sum to 1/6), hexahedra on
/// [−1, 1]³ (8), triangles on the unit simplex (1/2), quadrilaterals on [−1, 1]² (4).
///
/// Tetrahedra: 4 points, degree 2; 14 points, degree 5, all weights positive (Walkington 2000).
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mesh/element_type.hpp"

namespace microslip::fem {

struct QuadraturePoint {
  Eigen::Vector3d position;  ///< third entry 0 on faces
  double weight = 0.0;
};
using QuadratureRule = std::vector<QuadraturePoint>;

enum class StiffnessRule {
  accurate,  ///< 14 points on tet10: curved elements to some 1e-6 in frequency
  reduced,   ///< 4 points on tet10, as CalculiX: exact on straight elements, to 1e-4 on curved ones
};

[[nodiscard]] const QuadratureRule& stiffness_rule(mesh::ElementType type, StiffnessRule rule);
/// Exact for the mass of straight-sided elements.
[[nodiscard]] const QuadratureRule& mass_rule(mesh::ElementType type);
[[nodiscard]] const QuadratureRule& face_rule(mesh::FaceType type);

}  // namespace microslip::fem
