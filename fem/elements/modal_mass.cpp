#include "fem/modal_mass.hpp"

#include <stdexcept>
#include <string>

#include "fem/elements/element_matrices.hpp"

namespace microslip::fem {

namespace {

void require_rows(const mesh::Mesh& mesh, const Eigen::MatrixXd& shapes) {
  if (shapes.rows() == 3 * mesh.n_nodes()) return;
  throw std::invalid_argument("shapes have " + std::to_string(shapes.rows()) +
                              " rows, 3 per mesh node are " + std::to_string(3 * mesh.n_nodes()));
}

}  // namespace

Eigen::MatrixXd modal_mass(const mesh::Mesh& mesh, double density, const Eigen::MatrixXd& shapes) {
  require_rows(mesh, shapes);
  const Material material{1.0, 0.0, density};  // the mass does not depend on stiffness
  check_material(material);
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(shapes.cols(), shapes.cols());
  ElementMatrices matrices;
  for (const mesh::ElementBlock& block : mesh.elements()) {
    Eigen::MatrixXd own(block.connectivity.cols(), shapes.cols());
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      const Eigen::VectorX<Eigen::Index> nodes = block.connectivity.row(e).transpose();
      element_matrices(block.type, mesh.nodes()(nodes, Eigen::all), material, Tet10Rule::accurate,
                       matrices);
      for (int d = 0; d < 3; ++d) {
        own = shapes(3 * nodes.array() + d, Eigen::all);
        G.noalias() += own.transpose() * matrices.mass * own;
      }
    }
  }
  return G;
}

Eigen::VectorXd modal_stiffness(const mesh::Mesh& mesh, const Material& material,
                                const Eigen::MatrixXd& shapes) {
  require_rows(mesh, shapes);
  check_material(material);
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(shapes.cols());
  ElementMatrices matrices;
  for (const mesh::ElementBlock& block : mesh.elements()) {
    Eigen::MatrixXd own(3 * block.connectivity.cols(), shapes.cols());
    for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
      const Eigen::VectorX<Eigen::Index> nodes = block.connectivity.row(e).transpose();
      element_matrices(block.type, mesh.nodes()(nodes, Eigen::all), material, Tet10Rule::accurate,
                       matrices);
      for (Eigen::Index i = 0; i < nodes.size(); ++i) {
        own.middleRows<3>(3 * i) = shapes.middleRows<3>(3 * nodes[i]);
      }
      stiffness += own.cwiseProduct(matrices.stiffness * own).colwise().sum().transpose();
    }
  }
  return stiffness;
}

}  // namespace microslip::fem
