/// @file
/// How much too high natural frequencies are by the elements of their mesh, told from that mesh
/// alone: by how much the stress jumps from element to element.
///
///   η² = Σ_e ∫ (σ* − σ) : C⁻¹ : (σ* − σ) dV,    f₀/f ≈ (1 + s η²/φᵀKφ)^−½                    (1)
///
/// Eigenvalues lie above their limit by the energy of the error of their shape. σ is the stress of
/// a shape at the points at which its stiffness is integrated; σ* is made linear in every element,
/// averaged at each node by volume, and interpolated by the shape functions: nearer to the truth
/// where that is smooth.
///
/// η² alone is 0.3 to 0.7 of the error of the first three modes of the default blade on elements of
/// 3 to 20 mm: what a re-entrant edge does to the shape far from it makes no jumps. s = 2.
///
/// Sources: Zienkiewicz & Zhu, A simple error estimator and adaptive procedure for practical
/// engineering analysis, Int. J. Numer. Methods Eng. 24 (1987) 337–357; Strang & Fix, An Analysis
/// of the Finite Element Method (1973), section 6.3. s is measured.
/// @note A size, no bound: test_stress_jumps.cpp has it within a factor of two and a half.
#pragma once

#include <Eigen/Core>

#include "fem/material.hpp"
#include "mesh/mesh.hpp"

namespace microslip::fem {

/// (f − f₀)/f [-] by (1) of every shape, below 1; 0 where nothing is strained. K is that of the
/// elements alone, without what rotation adds.
/// @param shapes  3 n_nodes × n, x y z per mesh node, of any scale.
/// @param material  of the whole mesh; E and the density do not matter.
/// @throws std::invalid_argument  a material out of range, or another number of rows.
[[nodiscard]] Eigen::VectorXd frequency_excess(const mesh::Mesh& mesh, const Material& material,
                                               const Eigen::MatrixXd& shapes);

}  // namespace microslip::fem
