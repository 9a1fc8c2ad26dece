#include "fem/modal_analysis.hpp"
#include "fem/module/fem_module.hpp"

namespace microslip::fem {

Structure::Structure(const mesh::Mesh& mesh, const Material& material,
                     const std::vector<std::string>& clamped, Tet10Rule rule, SolverKind solver)
    : solver_(fem_module().assembled(mesh, material, clamped, rule, solver)) {}

Structure::Structure(const mesh::Mesh& mesh, const GivenMatrices& matrices, SolverKind solver)
    : solver_(fem_module().given(mesh, matrices, solver)) {}

Structure::~Structure() = default;
Structure::Structure(Structure&&) noexcept = default;
Structure& Structure::operator=(Structure&&) noexcept = default;

Eigen::VectorXd Structure::rotate(const mesh::Mesh& mesh, const Material& material,
                                  const Rotation& rotation, const Eigen::VectorXd& known) {
  return solver_->rotate(mesh, material, rotation, known);
}

Eigen::Index Structure::n_dofs() const { return solver_->n_dofs(); }
double Structure::mass() const { return solver_->mass(); }
const ModalTimings& Structure::timings() const { return solver_->timings(); }

ModalBasis Structure::solve_modes(const ModalOptions& options) {
  return solver_->solve_modes(options);
}

std::optional<Eigen::Index> Structure::count_modes() { return solver_->count_modes(); }

Eigen::MatrixXd Structure::solve_static(const Eigen::MatrixXd& forces) {
  return solver_->solve_static(forces);
}

ResidualFlexibility Structure::residual_flexibility(const ModalBasis& basis,
                                                    const mesh::Surface& surface,
                                                    const mesh::FaceFrame& frame) {
  return solver_->residual_flexibility(basis, surface, frame);
}

AttachedBasis Structure::attach(const ModalBasis& basis, const std::vector<AttachmentFace>& faces,
                                const Eigen::MatrixXd& forces, const AttachmentOptions& options) {
  return solver_->attach(basis, faces, forces, options);
}

}  // namespace microslip::fem
