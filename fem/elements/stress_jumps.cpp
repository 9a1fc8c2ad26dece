#include "fem/stress_jumps.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <Eigen/QR>

#include "fem/elements/element_matrices.hpp"
#include "mesh/shape_functions.hpp"

namespace microslip::fem {
namespace {

constexpr int n_components = 6;  // xx yy zz, then √2 times xy yz zx: products are those of tensors
constexpr double safety = 2.0;

/// 1, ξ, η, ζ of every row.
Eigen::MatrixX4d linear(const Eigen::MatrixX3d& places) {
  Eigen::MatrixX4d values(places.rows(), 4);
  values << Eigen::VectorXd::Ones(places.rows()), places;
  return values;
}

/// Points of an element at which it has stress.
struct PointTable {
  QuadratureRule rule;
  std::vector<mesh::ElementShapes> shapes;
  Eigen::MatrixXd to_nodes;  ///< n_nodes × n_points: the linear function nearest to their values

  PointTable(mesh::ElementType type, QuadratureRule given) : rule(std::move(given)) {
    for (const auto& point : rule.points.rowwise()) {
      shapes.push_back(mesh::shapes(type, point.transpose()));
    }
    const Eigen::MatrixXd fit =
        linear(rule.points).completeOrthogonalDecomposition().pseudoInverse();
    to_nodes = linear(mesh::reference_nodes(type)) * fit;
  }
};

/// Stresses of all shapes at the points of one element.
struct ElementStress {
  Eigen::MatrixXd values;  ///< n_points × 6 n_shapes [Pa per unit of a shape]
  Eigen::VectorXd volume;  ///< of the points [m³]
};

/// Sums over the elements of a mesh.
class Recovery {
 public:
  Recovery(const mesh::Mesh& mesh, const Material& material, Eigen::MatrixXd shapes)
      : mesh_(mesh),
        lame_(material),
        poisson_(material.poissons_ratio),
        shapes_(std::move(shapes)) {}

  [[nodiscard]] Eigen::VectorXd excess() {
    average();
    Eigen::VectorXd jumps = Eigen::VectorXd::Zero(shapes_.cols());
    Eigen::VectorXd energy = jumps;
    for_each([&](const PointTable& table, const Eigen::VectorX<Eigen::Index>& nodes,
                 const ElementStress& stress) {
      const Eigen::MatrixXd own = nodal_(nodes, Eigen::all);
      for (std::size_t q = 0; q < table.shapes.size(); ++q) {
        const auto i = static_cast<Eigen::Index>(q);
        const Eigen::RowVectorXd smooth = table.shapes[q].values.transpose() * own;
        add_energy(smooth - stress.values.row(i), stress.volume[i], jumps);
        add_energy(stress.values.row(i), stress.volume[i], energy);
      }
    });
    const Eigen::ArrayXd share = safety * jumps.array() / energy.array();
    return (energy.array() > 0.0).select(1.0 - (1.0 + share).rsqrt(), 0.0);
  }

 private:
  template <typename Visit>
  void for_each(const Visit& visit) const {
    ElementStress stress;
    for (const mesh::ElementBlock& block : mesh_.elements()) {
      std::map<Eigen::Index, PointTable> tables;  // straight and curved ones have other points
      for (Eigen::Index e = 0; e < block.connectivity.rows(); ++e) {
        const Eigen::VectorX<Eigen::Index> nodes = block.connectivity.row(e).transpose();
        const Eigen::MatrixX3d places = mesh_.nodes()(nodes, Eigen::all);
        const QuadratureRule& rule = stiffness_rule(block.type, places, Tet10Rule::accurate);
        const PointTable& table =
            tables.try_emplace(rule.weights.size(), block.type, rule).first->second;
        find_stress(table, nodes, places, stress);
        visit(table, nodes, stress);
      }
    }
  }

  void find_stress(const PointTable& table, const Eigen::VectorX<Eigen::Index>& nodes,
                   const Eigen::MatrixX3d& places, ElementStress& stress) const {
    const auto n_points = static_cast<Eigen::Index>(table.shapes.size());
    stress.values.resize(n_points, n_components * shapes_.cols());
    stress.volume.resize(n_points);
    for (Eigen::Index q = 0; q < n_points; ++q) {
      const auto& reference = table.shapes[static_cast<std::size_t>(q)].gradients;
      const Eigen::Matrix3d jacobian = reference.transpose() * places;
      const Eigen::Matrix3Xd g = jacobian.inverse() * reference.transpose();
      stress.volume[q] = table.rule.weights[q] * jacobian.determinant();
      for (Eigen::Index k = 0; k < shapes_.cols(); ++k) {
        Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
        for (Eigen::Index i = 0; i < nodes.size(); ++i) {
          gradient += shapes_.col(k).segment<3>(3 * nodes[i]) * g.col(i).transpose();
        }
        stress.values.row(q).segment<n_components>(n_components * k) = of_gradient(gradient);
      }
    }
  }

  [[nodiscard]] Eigen::RowVector<double, n_components> of_gradient(const Eigen::Matrix3d& g) const {
    const Eigen::Vector3d direct =
        2.0 * lame_.mu * g.diagonal() + Eigen::Vector3d::Constant(lame_.lambda * g.trace());
    const double to_pair = std::numbers::sqrt2 * lame_.mu;
    return {direct[0],
            direct[1],
            direct[2],
            to_pair * (g(0, 1) + g(1, 0)),
            to_pair * (g(1, 2) + g(2, 1)),
            to_pair * (g(2, 0) + g(0, 2))};
  }

  /// Of σ : C⁻¹ : σ = [(1 + ν) σ:σ − ν tr² σ]/E, without E.
  void add_energy(const Eigen::RowVectorXd& stress, double volume, Eigen::VectorXd& sum) const {
    for (Eigen::Index k = 0; k < sum.size(); ++k) {
      const auto own = stress.segment<n_components>(n_components * k);
      const double trace = own.head<3>().sum();
      sum[k] += volume * ((1.0 + poisson_) * own.squaredNorm() - poisson_ * trace * trace);
    }
  }

  void average() {
    nodal_ = Eigen::MatrixXd::Zero(mesh_.n_nodes(), n_components * shapes_.cols());
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(mesh_.n_nodes());
    for_each([&](const PointTable& table, const Eigen::VectorX<Eigen::Index>& nodes,
                 const ElementStress& stress) {
      const double volume = stress.volume.sum();
      const Eigen::MatrixXd own = volume * (table.to_nodes * stress.values);
      for (Eigen::Index i = 0; i < nodes.size(); ++i) {
        nodal_.row(nodes[i]) += own.row(i);
        weight[nodes[i]] += volume;
      }
    });
    nodal_.array().colwise() /= (weight.array() > 0.0).select(weight.array(), 1.0);
  }

  const mesh::Mesh& mesh_;
  LameConstants lame_;
  double poisson_;
  Eigen::MatrixXd shapes_;
  Eigen::MatrixXd nodal_;  ///< σ* at the nodes, n_nodes × 6 n_shapes
};

}  // namespace

Eigen::VectorXd frequency_excess(const mesh::Mesh& mesh, const Material& material,
                                 const Eigen::MatrixXd& shapes) {
  check_material(material);
  if (shapes.rows() != 3 * mesh.n_nodes()) {
    throw std::invalid_argument("shapes have " + std::to_string(shapes.rows()) +
                                " rows, 3 per mesh node are " + std::to_string(3 * mesh.n_nodes()));
  }
  constexpr Eigen::Index at_once = 8;  // stress at the nodes takes six numbers of each
  Eigen::VectorXd excess(shapes.cols());
  for (Eigen::Index first = 0; first < shapes.cols(); first += at_once) {
    const Eigen::Index n = std::min(at_once, shapes.cols() - first);
    excess.segment(first, n) = Recovery(mesh, material, shapes.middleCols(first, n)).excess();
  }
  return excess;
}

}  // namespace microslip::fem
