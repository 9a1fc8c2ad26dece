#pragma once

#include <optional>
#include <vector>

#include "fem/modal_analysis.hpp"

namespace microslip::fem {

/// What answers for a Structure; each question as there.
class StructureSolver {
 public:
  StructureSolver() = default;
  virtual ~StructureSolver() = default;
  StructureSolver(const StructureSolver&) = delete;
  StructureSolver& operator=(const StructureSolver&) = delete;
  StructureSolver(StructureSolver&&) = delete;
  StructureSolver& operator=(StructureSolver&&) = delete;

  virtual Eigen::VectorXd rotate(const mesh::Mesh& mesh, const Material& material,
                                 const Rotation& rotation, const Eigen::VectorXd& known) = 0;
  [[nodiscard]] virtual Eigen::Index n_dofs() const = 0;
  [[nodiscard]] virtual double mass() const = 0;
  [[nodiscard]] virtual ModalBasis solve_modes(const ModalOptions& options) = 0;
  [[nodiscard]] virtual std::optional<Eigen::Index> count_modes() = 0;
  [[nodiscard]] virtual Eigen::MatrixXd solve_static(const Eigen::MatrixXd& forces) = 0;
  [[nodiscard]] virtual ResidualFlexibility residual_flexibility(const ModalBasis& basis,
                                                                 const mesh::Surface& surface,
                                                                 const mesh::FaceFrame& frame) = 0;
  [[nodiscard]] virtual AttachedBasis attach(const ModalBasis& basis,
                                             const std::vector<AttachmentFace>& faces,
                                             const Eigen::MatrixXd& forces,
                                             const AttachmentOptions& options) = 0;
  [[nodiscard]] virtual const ModalTimings& timings() const = 0;
};

}  // namespace microslip::fem
