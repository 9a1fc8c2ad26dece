/// @file
/// Natural frequencies and static contact from CalculiX (the program `ccx`),
/// an independent finite-element code.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fem/material.hpp"
#include "fem/rotation.hpp"
#include "mesh/mesh.hpp"

namespace microslip::test {

/// True if `ccx` is on PATH.
[[nodiscard]] bool has_calculix();

/// Frequencies [rad/s] of the lowest modes of a mesh, ascending, as CalculiX prints them (7
/// digits). Node order is that of Abaqus already. Works in a folder of its own below the system's
/// temporary one and removes it.
/// @param clamped  names of surfaces or node sets that are held.
/// @param rotation  with a speed: of the body in static equilibrium with its centrifugal load,
///                  large displacements (*STATIC with NLGEOM, then *FREQUENCY with PERTURBATION,
///                  the load still on).
/// @throws std::runtime_error  ccx failed or printed fewer frequencies; with its last words.
[[nodiscard]] Eigen::VectorXd calculix_frequencies(const mesh::Mesh& mesh,
                                                   const fem::Material& material,
                                                   const std::vector<std::string>& clamped,
                                                   int n_modes, const fem::Rotation& rotation = {});

/// A face against the ground, and what presses it.
struct CalculixLayer {
  std::string surface;     ///< plane, on tetrahedra
  double stiffness = 0.0;  ///< pressure per overclosure [N/m³]
  Eigen::VectorXd load;    ///< on the nodes, 3 n_nodes [N]; may be empty
  fem::Rotation rotation{};
};

struct CalculixContact {
  double force = 0.0;             ///< normal, compression [N]
  Eigen::MatrixX3d displacement;  ///< of the nodes of the surface [m]
};

/// Linear static equilibrium with contact without friction (TYPE=SURFACE TO SURFACE,
/// PRESSURE-OVERCLOSURE=LINEAR).
/// @throws std::runtime_error  ccx failed or printed less than this.
[[nodiscard]] CalculixContact calculix_contact(const mesh::Mesh& mesh,
                                               const fem::Material& material,
                                               const std::vector<std::string>& clamped,
                                               const CalculixLayer& layer);

}  // namespace microslip::test
