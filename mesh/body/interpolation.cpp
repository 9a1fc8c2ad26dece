#include "mesh/interpolation.hpp"

#include <vector>

#include "mesh/elements/element_locator.hpp"
#include "mesh/mesh_error.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::mesh {

Eigen::SparseMatrix<double, Eigen::RowMajor> interpolation(const Mesh& mesh,
                                                           const Eigen::MatrixX3d& places) {
  const ElementLocator locator(mesh.nodes(), mesh.elements());
  std::vector<Eigen::Triplet<double>> weights;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const auto place = locator.deepest(places.row(i).transpose());
    if (!place) throw MeshError("interpolation: a place lies outside the mesh");
    const ElementBlock& block = mesh.elements()[place->element.block];
    const auto values = shapes(block.type, place->xi).values;
    for (Eigen::Index a = 0; a < values.size(); ++a) {
      weights.emplace_back(i, block.connectivity(place->element.element, a), values[a]);
    }
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(places.rows(), mesh.n_nodes());
  matrix.setFromTriplets(weights.begin(), weights.end());
  return matrix;
}

}  // namespace microslip::mesh
