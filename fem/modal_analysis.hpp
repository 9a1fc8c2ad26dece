/// @file
/// Mesh and material → modes and residual flexibility. Collective over all MPI
/// ranks; results are complete on every rank.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "fem/attachment.hpp"
#include "fem/elements/element_matrices.hpp"
#include "fem/given_matrices.hpp"
#include "fem/material.hpp"
#include "fem/modal_basis.hpp"
#include "fem/rotation.hpp"
#include "fem/solver_kind.hpp"
#include "mesh/mesh.hpp"

namespace microslip::fem {

/// When the modes are counted that the search may have missed: as they are found, or by
/// count_modes(), when the factorisation is no longer needed and does not lie in memory beside that
/// of the count.
enum class CountTime : std::uint8_t { at_once, at_the_end };

struct ModalOptions {
  Eigen::Index n_modes = 10;  ///< ≥ 1; rigid-body modes count
  double residual_tolerance =
      1e-8;  ///< of each pair, checked, plus what rounding of φ alone leaves
  CountTime count = CountTime::at_once;
};

/// Where the time went [s].
struct ModalTimings {
  double assembly = 0.0;
  double factorisation =
      0.0;  ///< numerical, of K (or of K shifted, if K is singular); or the levels of multigrid
  double ordering = 0.0;    ///< analysis before it
  double eigensolve = 0.0;  ///< Krylov–Schur and refinement
  double inertia = 0.0;     ///< the count: ordering and factorisation of its own
};

class StructureSolver;  // fem/eigen/structure_solver.hpp

/// Owns K, M and one factorisation, or the levels of multigrid;
/// answers modes and static questions about one structure.
class Structure {
 public:
  /// Assembles. @param clamped  names of surfaces or node sets of the mesh that are held.
  /// @throws mesh::MeshError  an unknown name; std::invalid_argument a material out of range.
  Structure(const mesh::Mesh& mesh, const Material& material,
            const std::vector<std::string>& clamped, Tet10Rule rule = Tet10Rule::accurate,
            SolverKind solver = SolverKind::direct);
  /// Takes K and M from elsewhere.
  /// @throws mesh::MeshError, std::invalid_argument  see GivenMatrices.
  Structure(const mesh::Mesh& mesh, const GivenMatrices& matrices,
            SolverKind solver = SolverKind::direct);
  ~Structure();
  Structure(Structure&&) noexcept;
  Structure& operator=(Structure&&) noexcept;
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;

  /// Lets the body rotate with its supports: K is from now on that of small motions about the
  /// static equilibrium under the centrifugal load (fem/assembly/rotating_system.hpp), and so are
  /// modes and solutions. Once more with another speed: begun from the equilibrium before. Springs
  /// that were added are gone.
  /// @param mesh, material  those it was made of.
  /// @param known           the displacement, where it was found before; empty: it was not.
  /// @return displacement of the equilibrium, 3 n_nodes [m].
  /// @throws EigenError  "rotation: …": the body floats, no equilibrium is found,
  ///         or it is not stable there.
  Eigen::VectorXd rotate(const mesh::Mesh& mesh, const Material& material, const Rotation& rotation,
                         const Eigen::VectorXd& known = {});
  [[nodiscard]] Eigen::Index n_dofs() const;  ///< free degrees of freedom
  [[nodiscard]] double mass() const;          ///< [kg]
  /// @throws EigenError  fewer modes than asked, a pair not accurate, a missed mode, more zero
  ///         modes than a free body has or a mechanism inside it; with numbers.
  [[nodiscard]] ModalBasis solve_modes(const ModalOptions& options);
  /// The count that solve_modes() has put off. The factorisation is given up; the next question
  /// makes it anew.
  /// @return ModalBasis::inertia_count. Empty: the search has missed some; solve_modes() that
  ///         counts at once finds them.
  [[nodiscard]] std::optional<Eigen::Index> count_modes();
  /// Displacement under loads: columns of F (3 n_nodes × m) [N] → u (3 n_nodes × m) [m].
  /// @throws EigenError  rigid-body modes: K is singular.
  [[nodiscard]] Eigen::MatrixXd solve_static(const Eigen::MatrixXd& forces);
  /// Three static solves for a uniform unit traction on the surface along p, q and r of each place,
  /// minus what the modes of `basis` carry (theory section 14). With rigid-body modes:
  /// inertia relief.
  [[nodiscard]] ResidualFlexibility residual_flexibility(const ModalBasis& basis,
                                                         const mesh::Surface& surface,
                                                         const mesh::FaceFrame& frame);
  /// The modes of `basis` and attachment shapes behind them (fem/attachment.hpp): one static solve
  /// for each traction on the faces along p, q and r of each place, of the same degree on all, and
  /// for each column of `forces`.
  /// @param forces  3 n_nodes × m [N], m ≥ 0: the excitation.
  /// @note With rigid-body modes: inertia relief, as residual_flexibility().
  [[nodiscard]] AttachedBasis attach(const ModalBasis& basis,
                                     const std::vector<AttachmentFace>& faces,
                                     const Eigen::MatrixXd& forces,
                                     const AttachmentOptions& options = {});
  [[nodiscard]] const ModalTimings& timings() const;

 private:
  std::unique_ptr<StructureSolver> solver_;
};

}  // namespace microslip::fem
