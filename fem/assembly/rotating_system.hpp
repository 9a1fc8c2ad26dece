/// @file
/// Static equilibrium of a body that rotates with its supports, and small motions about it, told in
/// axes that rotate with it.
///
///   f(u) = Ω² ∫ ρ Nᵀ P (x + u − o) dV,   P = I − e eᵀ                                          (1)
///   K = ∂f/∂u − Ω² ∫ ρ Nᵀ P N dV                                                               (2)
///
/// f is the internal force (deformed_element.hpp), e the direction of the axis, o a point of it.
/// (1) is solved by Newton's method with (2), which in the end is the stiffness of small motions:
/// of the stresses (centrifugal stiffening), of the place the body has moved to, and less what the
/// load gains with distance (spin softening). Gyroscopic forces 2Ω ∫ ρ Nᵀ e × u̇ dV are left out:
/// along a blade's bending they are small, and the modes stay real.
///
/// The load is that of the mass matrix, Ω² M P (x + u − o), rows of held nodes left out.
#pragma once

#include "fem/assembly/fe_system.hpp"
#include "fem/rotation.hpp"

namespace microslip::fem {

struct Equilibrium {
  Eigen::VectorXd displacement;  ///< 3 n_nodes [m], 0 where held
  double speed = 0.0;            ///< [rad/s], about the same axis
};

/// Finds the equilibrium (1) and leaves (2) as the stiffness of the system: at once, or where that
/// does not end in steps of the square of the speed.
/// @param system  of this mesh, material and rule.
/// @param start   to begin with.
/// @return u, complete on every rank, 3 n_nodes [m]; out-of-balance force 1e-9 of the load, or a
///         last correction 1e-9 of u.
/// @throws EigenError  "rotation: …": no equilibrium is found, none with strains
///         below 0.2, or K has negative eigenvalues there.
[[nodiscard]] Eigen::VectorXd rotate_system(FeSystem& system, const mesh::Mesh& mesh,
                                            const Material& material, Tet10Rule rule,
                                            const Rotation& rotation, const Equilibrium& start);

}  // namespace microslip::fem
