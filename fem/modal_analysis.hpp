/// @file
/// Mesh and material → modes and residual flexibility. Collective over the MPI ranks of
/// PETSC_COMM_WORLD; results are complete on every rank.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "fem/element_matrices.hpp"
#include "fem/material.hpp"
#include "fem/modal_basis.hpp"
#include "mesh/mesh.hpp"

namespace microslip::fem {

struct ModalOptions {
  Eigen::Index n_modes = 10;         ///< 1 … n_dofs; rigid-body modes count
  /// Of each pair, checked; or the rounding of the product Kφ itself, 16 ε ‖diag(K) φ‖ / ‖Kφ‖, where
  /// that is larger (slender bodies on fine meshes).
  double residual_tolerance = 1e-8;
};

/// Springs to ground on a surface: K += Σ_c w_c Σ_d k_cd (N_c e_d)(N_c e_d)ᵀ over points c and the
/// three axes e_d.
struct SurfaceSprings {
  Eigen::SparseMatrix<double> interpolation;  ///< N, n_points × surface nodes
  Eigen::VectorXd weights;                    ///< w [m²], n_points
  Eigen::Matrix3d frame;                      ///< axes e_d in its rows, orthonormal
  Eigen::MatrixX3d stiffness;                 ///< k per area along each axis [N/m³], n_points × 3, ≥ 0
};

/// Where the time went [s].
struct ModalTimings {
  double assembly = 0.0;
  double ordering = 0.0;       ///< symbolic factorisation of K
  double factorisation = 0.0;  ///< numeric
  double eigensolve = 0.0;
  double inertia = 0.0;        ///< ordering and factorisation of the check of the count
};

/// Owns K, M and one factorisation; answers modes and static questions about one structure.
class Structure {
 public:
  /// Assembles. @param clamped  names of surfaces or node sets of the mesh that are held.
  /// @throws mesh::MeshError  an unknown name; std::invalid_argument a material out of range.
  Structure(const mesh::Mesh& mesh, const Material& material, const std::vector<std::string>& clamped,
            Tet10Stiffness rule = Tet10Stiffness::accurate);
  ~Structure();
  Structure(Structure&&) noexcept;
  Structure& operator=(Structure&&) noexcept;
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;

  [[nodiscard]] Eigen::Index n_dofs() const;  ///< free degrees of freedom
  [[nodiscard]] double mass() const;          ///< [kg]
  /// Adds springs to K; what was factorised before is forgotten. Points must interpolate within one
  /// face each. @throws std::invalid_argument  sizes that do not match, a negative stiffness.
  void add_surface_springs(const mesh::Surface& surface, const SurfaceSprings& springs);
  /// The lowest modes, rigid-body modes first. The largest component of each is positive.
  /// @throws EigenError  fewer modes than asked, a pair not accurate, a missed mode ("eigen-missed-
  ///         mode: …"), or zero frequencies beyond six rigid-body modes ("mechanism: …"); with
  ///         numbers. std::invalid_argument  n_modes out of range.
  [[nodiscard]] ModalBasis solve_modes(const ModalOptions& options);
  /// Displacement under loads: columns of F (3 n_nodes × m) [N] → u (3 n_nodes × m) [m].
  /// @throws EigenError  rigid-body modes: K is singular.
  [[nodiscard]] Eigen::MatrixXd solve_static(const Eigen::MatrixXd& forces);
  /// Undamped vibration under loads F cos ωt away from resonance: (K − ω²M) u = F, columns as above.
  /// @param frequency  ω [rad/s].
  [[nodiscard]] Eigen::MatrixXd solve_harmonic(const Eigen::MatrixXd& forces, double frequency);
  /// Three static solves for a uniform unit traction on the surface along each row of `frame`, less
  /// what the modes of the basis take (theory section 14). Without supports the static solution is
  /// that of inertia relief: rigid-body acceleration removed, no rigid-body displacement.
  [[nodiscard]] ResidualFlexibility residual_flexibility(const ModalBasis& basis,
                                                         const mesh::Surface& surface,
                                                         const Eigen::Matrix3d& frame);
  [[nodiscard]] const ModalTimings& timings() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace microslip::fem
