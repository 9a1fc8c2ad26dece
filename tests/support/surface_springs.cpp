#include "tests/support/surface_springs.hpp"

#include "fem/eigen/mode_search.hpp"
#include "fem/petsc/factorisation.hpp"
#include "fem/petsc/petsc_check.hpp"

namespace microslip::test {
namespace {

using fem::check;

void add_springs(fem::FeSystem& system, const SurfaceSprings& springs) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> points(springs.to_points);
  const Mat K = system.stiffness.get();
  std::vector<PetscInt> index;
  std::vector<double> N;
  fem::NodeBlocks block;
  for (Eigen::Index c = 0; c < points.rows(); ++c) {
    index.clear();
    N.clear();
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(points, c); it; ++it) {
      const Eigen::Index node = springs.surface.nodes[static_cast<std::size_t>(it.col())];
      index.push_back(static_cast<PetscInt>(system.dofs.solver_node(node)));
      N.push_back(it.value());
    }
    const Eigen::Matrix3d& frame = springs.frame_at(c);
    const Eigen::Matrix3d spring =
        springs.weights[c] * frame.transpose() * springs.stiffness.row(c).asDiagonal() * frame;
    const auto n = static_cast<Eigen::Index>(N.size());
    block.resize(3 * n, 3 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        block.block<3, 3>(3 * i, 3 * j) =
            N[static_cast<std::size_t>(i)] * N[static_cast<std::size_t>(j)] * spring;
      }
    }
    const auto n_nodes = static_cast<PetscInt>(n);
    check(MatSetValuesBlocked(K, n_nodes, index.data(), n_nodes, index.data(), block.data(),
                              ADD_VALUES));
  }
  check(MatAssemblyBegin(K, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(K, MAT_FINAL_ASSEMBLY));
}

}  // namespace

SprungStructure::SprungStructure(const mesh::Mesh& mesh, const fem::Material& material,
                                 const std::vector<std::string>& clamped,
                                 const SurfaceSprings& springs)
    : system_(fem::assemble(mesh, material, clamped)) {
  add_springs(system_, springs);
}

SprungModes SprungStructure::modes(Eigen::Index n) const {
  const fem::Factorisation inverse(system_.stiffness.get(), fem::FactorKind::positive_definite);
  const Eigen::MatrixXd no_rigid(system_.dofs.n_local_dofs(), 0);
  const fem::EigenPairs pairs = fem::find_elastic_modes(system_, inverse, 0.0, n, no_rigid).pairs;
  return {pairs.values.head(n).cwiseSqrt(), system_.dofs.to_mesh(pairs.vectors.leftCols(n))};
}

Eigen::MatrixXd SprungStructure::response(double frequency, const Eigen::MatrixXd& forces) const {
  const fem::Factorisation dynamic(fem::shifted_stiffness(system_, frequency * frequency).get(),
                                   fem::FactorKind::indefinite);
  return system_.dofs.to_mesh(dynamic.solve(system_.dofs.to_local(forces)));
}

}  // namespace microslip::test
