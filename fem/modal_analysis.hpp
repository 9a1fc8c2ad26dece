/// @file
/// Mesh and material → modes and residual flexibility. Collective over the MPI ranks of
/// PETSC_COMM_WORLD; results are complete on every rank.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "fem/fe_system.hpp"
#include "fem/material.hpp"
#include "fem/modal_basis.hpp"
#include "mesh/mesh.hpp"

namespace microslip::fem {

struct ModalOptions {
  Eigen::Index n_modes = 10;         ///< ≥ 1; rigid-body modes count
  double residual_tolerance = 1e-8;  ///< of each pair, checked
};

/// Where the time went [s].
struct ModalTimings {
  double assembly = 0.0;
  double factorisation = 0.0;  ///< ordering included where the library does not separate it
  double ordering = 0.0;
  double eigensolve = 0.0;
  double inertia = 0.0;
};

/// Owns K, M and one factorisation; answers modes and static questions about one structure.
class Structure {
 public:
  /// Assembles. @param clamped  names of surfaces or node sets of the mesh that are held.
  /// @throws mesh::MeshError  an unknown name; std::invalid_argument a material out of range.
  /// @param rule     quadrature of the stiffness.
  /// @param springs  added to K; nullptr: none.
  Structure(const mesh::Mesh& mesh, const Material& material,
            const std::vector<std::string>& clamped,
            StiffnessRule rule = StiffnessRule::accurate, const SurfaceSprings* springs = nullptr);
  ~Structure();
  Structure(Structure&&) noexcept;
  Structure& operator=(Structure&&) noexcept;
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;

  [[nodiscard]] Eigen::Index n_dofs() const;  ///< free degrees of freedom
  [[nodiscard]] double mass() const;          ///< [kg]
  /// @throws EigenError  fewer modes than asked, a pair not accurate, or a missed mode; with numbers.
  [[nodiscard]] ModalBasis solve_modes(const ModalOptions& options);
  /// Displacement under loads: columns of F (3 n_nodes × m) [N] → u (3 n_nodes × m) [m].
  /// @throws EigenError  rigid-body modes: K is singular.
  [[nodiscard]] Eigen::MatrixXd solve_static(const Eigen::MatrixXd& forces);
  /// Three static solves for a uniform unit traction on the surface along each row of `frame`.
  [[nodiscard]] ResidualFlexibility residual_flexibility(const ModalBasis& basis,
                                                         const mesh::Surface& surface,
                                                         const Eigen::Matrix3d& frame);
  /// (K − ω²M)⁻¹ F without damping. @param frequency  ω [rad/s], off every resonance.
  [[nodiscard]] Eigen::MatrixXd solve_harmonic(double frequency, const Eigen::MatrixXd& forces);
  [[nodiscard]] const ModalTimings& timings() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace microslip::fem
