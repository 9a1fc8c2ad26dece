/// @file
/// Quadrature rules on the reference elements.
///
/// Tetrahedra: {ξ, η, ζ ≥ 0, ξ + η + ζ ≤ 1}, weights sum to 1/6. Triangles: {ξ, η ≥ 0, ξ + η ≤ 1},
/// sum 1/2. Hexahedra [−1, 1]³, sum 8, and squares [−1, 1]², sum 4. Wedges: triangle × [−1, 1], sum
/// 1. Pyramids: base [−1, 1]², apex (0, 0, 1), sum 4/3.
///
/// Sources: tetrahedra of degree 2, Hammer, Marlowe & Stroud, Math. Tables Aids Comput. 10 (1956)
/// 130–137; of degree 5, 14 interior points, Walkington, Quadrature on simplices of arbitrary
/// dimension (2000); triangles of degree 2 and 4, 3 and 6 points, Strang & Fix, An Analysis of the
/// Finite Element Method (1973). Other degrees, and pyramids: products of Gauss–Jacobi rules
/// collapsed onto the simplex, or onto the apex, their points by Golub & Welsch, Math. Comput. 23
/// (1969) 221–230. No table is trusted: the unit test integrates every monomial up to the stated
/// degree.
#pragma once

#include <Eigen/Core>

#include "mesh/element_type.hpp"

namespace microslip::fem {

struct QuadratureRule {
  Eigen::MatrixX3d points;  ///< reference coordinates, n × 3 (ζ = 0 on faces)
  Eigen::VectorXd weights;  ///< n, positive
};

/// Points and weights of the n-point rule for ∫₋₁¹ (1 − x)^alpha f(x) dx, exact to degree 2n − 1.
/// @param alpha  Jacobi exponent, ≥ 0; 0 is Gauss–Legendre.
[[nodiscard]] QuadratureRule gauss_jacobi(int n, double alpha);

/// Tetrahedron rule exact for polynomials up to total degree `degree` ≥ 0; 4 points to degree 2,
/// 14 to degree 5, (degree/2 + 1)³ above.
[[nodiscard]] QuadratureRule tetrahedron_rule(int degree);

/// Triangle rule exact to total degree `degree`: 3 points to degree 2, 6 to degree 4,
/// (degree/2 + 1)² above.
[[nodiscard]] QuadratureRule triangle_rule(int degree);

/// n³ Gauss points on the hexahedron, exact to degree 2n − 1 in each direction.
[[nodiscard]] QuadratureRule hexahedron_rule(int n);

/// Triangle rule of the degree × n Gauss points over the height.
[[nodiscard]] QuadratureRule wedge_rule(int degree, int n);

/// n³ points inside the pyramid, exact for (1 − ζ)^k p(a, b), a = ξ/(1 − ζ), b = η/(1 − ζ), of
/// degree 2n − 1 in each of 1 − ζ, a and b: what shape functions of pyramids and their products
/// are.
[[nodiscard]] QuadratureRule pyramid_rule(int n);

/// n² Gauss points on the square.
[[nodiscard]] QuadratureRule square_rule(int n);

/// Rule on a face, exact to `degree` (total on triangles, per direction on quadrilaterals).
[[nodiscard]] QuadratureRule face_rule(mesh::FaceType type, int degree);

}  // namespace microslip::fem
