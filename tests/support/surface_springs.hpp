/// @file
/// Finite elements with springs between a surface and the ground, a contact that sticks everywhere,
/// solved directly: a reference for reduced models.
#pragma once

#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "fem/assembly/fe_system.hpp"
#include "mesh/mesh.hpp"

namespace microslip::test {

/// Spread over the points of a sampling.
struct SurfaceSprings {
  const mesh::Surface& surface;
  const Eigen::SparseMatrix<double>& to_points;  ///< n_points × surface.nodes.size()
  const Eigen::VectorXd& weights;                ///< area of each point [m²]
  Eigen::Matrix3d frame;                         ///< rows p, q, r
  Eigen::MatrixX3d stiffness;                    ///< along p, q, r at each point [N/m³]
  std::vector<Eigen::Matrix3d> own_frames{};     ///< of each point; empty: `frame` everywhere

  [[nodiscard]] const Eigen::Matrix3d& frame_at(Eigen::Index point) const {
    return own_frames.empty() ? frame : own_frames[static_cast<std::size_t>(point)];
  }
};

struct SprungModes {
  Eigen::VectorXd frequency;  ///< [rad/s]
  Eigen::MatrixXd shapes;     ///< 3 n_nodes × n_modes
};

/// K + Σ_c w_c Σ_d k_cd (N_c e_d)ᵀ(N_c e_d), e_d row d of the frame, for a body that is held.
class SprungStructure {
 public:
  SprungStructure(const mesh::Mesh& mesh, const fem::Material& material,
                  const std::vector<std::string>& clamped, const SurfaceSprings& springs);

  [[nodiscard]] SprungModes modes(Eigen::Index n) const;
  /// Undamped harmonic response (K − ω²M) u = F, 3 n_nodes × m.
  [[nodiscard]] Eigen::MatrixXd response(double frequency, const Eigen::MatrixXd& forces) const;

 private:
  fem::FeSystem system_;
};

}  // namespace microslip::test
