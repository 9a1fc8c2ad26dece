#include "tests/verification/truth/face_model.hpp"

#include <array>
#include <map>
#include <stdexcept>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "fem/assembly/fe_system.hpp"
#include "fem/modal_analysis.hpp"
#include "fem/petsc/columns.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/mesher_process.hpp"
#include "mesh/shape_functions.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::truth {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const fem::Material steel{2.1e11, 0.3, 7800.0};

mesh::Mesh blade_mesh(double element_size) {
  const test::TemporaryFolder folder;
  mesh::mesh_blade({}, {element_size}, folder.path() / "blade.msh");
  return mesh::read_gmsh(folder.path() / "blade.msh");
}

/// Rows p, q, r.
Eigen::Matrix3d face_frame() {
  Eigen::Matrix3d frame;
  frame << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  return frame;
}

/// Unit forces on each node of the face along p, q, r and the excitation:
/// 3 n_nodes × (3 n_face + 1).
MatrixXd loads(const mesh::Mesh& mesh, const mesh::Surface& face, const FaceModelOptions& options) {
  const auto n_face = static_cast<Index>(face.nodes.size());
  MatrixXd result = MatrixXd::Zero(3 * mesh.n_nodes(), 3 * n_face + 1);
  const Eigen::Matrix3d frame = face_frame();
  for (Index axis = 0; axis < 3; ++axis) {
    for (Index i = 0; i < n_face; ++i) {
      const Index node = face.nodes[static_cast<std::size_t>(i)];
      result.block<3, 1>(3 * node, axis * n_face + i) = frame.row(axis).transpose();
    }
  }
  for (const char* name : {"B", "B'"}) {
    const Index node = mesh.node_set(name).front();
    result.block<3, 1>(3 * node, 3 * n_face) += options.force_amplitude * options.force_direction;
  }
  return result;
}

/// Attachment shapes of the loads as further modes: ω̃ and Ψ̃.
fem::ModalBasis attachment_modes(const mesh::Mesh& mesh, fem::Structure& structure,
                                 const fem::ModalBasis& free, const MatrixXd& F) {
  const VectorXd flexibility = free.frequency.array().square().inverse();
  const MatrixXd Psi = structure.solve_static(F) -
                       free.shapes * flexibility.asDiagonal() * (free.shapes.transpose() * F);
  const MatrixXd K = F.transpose() * Psi;  // ΨᵀKΨ, because ΨᵀKφ = 0
  const fem::FeSystem system = fem::assemble(mesh, steel, {"root"});
  const MatrixXd local = system.dofs.to_local(Psi);
  const MatrixXd M = fem::inner_products(local, fem::multiply(system.mass_matrix.get(), local));
  // μ = 1/ω̃², with unit ΨᵀKΨ: the stiffness is the better conditioned of the two
  const VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> pencil(
      scale.asDiagonal() * (0.5 * (M + M.transpose())) * scale.asDiagonal(),
      scale.asDiagonal() * (0.5 * (K + K.transpose())) * scale.asDiagonal());
  const VectorXd mu = pencil.eigenvalues().reverse();
  if (mu.minCoeff() <= 0.0) throw std::runtime_error("attachment shapes: mass is not positive");
  fem::ModalBasis result;
  result.frequency = mu.cwiseSqrt().cwiseInverse();
  result.shapes = Psi * (scale.asDiagonal() * pencil.eigenvectors().rowwise().reverse()) *
                  result.frequency.asDiagonal();
  return result;
}

/// Three-point rule on every part of every tri6 face cut into subdivision² triangles.
void set_points(FaceModel& model, const mesh::Mesh& mesh, const mesh::Surface& face,
                int subdivision) {
  std::map<Index, Index> local;
  for (const Index node : face.nodes) local.emplace(node, std::ssize(local));
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> weights;
  const double h = 1.0 / subdivision;
  const auto add = [&](const mesh::FaceBlock& block, Index f, const Eigen::Vector2d& xi) {
    const mesh::FaceShapes at = mesh::shapes(block.type, xi);
    Eigen::Matrix<double, 3, 2> J = Eigen::Matrix<double, 3, 2>::Zero();
    for (Index a = 0; a < at.values.size(); ++a) {
      const Index node = block.connectivity(f, a);
      J += mesh.nodes().row(node).transpose() * at.gradients.row(a);
      entries.emplace_back(static_cast<int>(weights.size()), static_cast<int>(local.at(node)),
                           at.values[a]);
    }
    weights.push_back(J.col(0).cross(J.col(1)).norm() * h * h / 6.0);
  };
  const auto add_triangle = [&](const mesh::FaceBlock& block, Index f,
                                const Eigen::Vector2d& corner, double turn) {
    for (const auto& [a, b] : {std::array{1.0, 1.0}, std::array{4.0, 1.0}, std::array{1.0, 4.0}}) {
      add(block, f, corner + turn * h / 6.0 * Eigen::Vector2d(a, b));
    }
  };
  for (const mesh::FaceBlock& block : face.faces) {
    if (block.type != mesh::FaceType::tri6) throw std::runtime_error("contact face: tri6 expected");
    for (Index f = 0; f < block.connectivity.rows(); ++f) {
      for (int i = 0; i < subdivision; ++i) {
        for (int j = 0; i + j < subdivision; ++j) {
          add_triangle(block, f, {i * h, j * h}, 1.0);
          if (i + j + 1 < subdivision) add_triangle(block, f, {(i + 1) * h, (j + 1) * h}, -1.0);
        }
      }
    }
  }
  model.weights = Eigen::Map<VectorXd>(weights.data(), std::ssize(weights));
  model.to_points.resize(std::ssize(weights), std::ssize(face.nodes));
  model.to_points.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

FaceModel build_face_model(const FaceModelOptions& options) {
  const mesh::Mesh mesh = blade_mesh(options.element_size);
  const mesh::Surface& face = mesh.surface("contact");
  fem::Structure structure(mesh, steel, {"root"});
  const fem::ModalBasis free = structure.solve_modes({.n_modes = options.n_modes});
  const MatrixXd F = loads(mesh, face, options);
  const fem::ModalBasis attached = attachment_modes(mesh, structure, free, F);

  FaceModel model;
  model.damping_ratio = options.damping_ratio;
  const Index n = free.frequency.size() + attached.frequency.size();
  model.frequency.resize(n);
  model.frequency << free.frequency, attached.frequency;
  MatrixXd shapes(free.shapes.rows(), n);
  shapes << free.shapes, attached.shapes;
  const MatrixXd on_loads = shapes.transpose() * F;
  model.at_face = on_loads.leftCols(F.cols() - 1);
  model.force = on_loads.col(F.cols() - 1);
  model.output = shapes.row(3 * mesh.node_set("A").front()).transpose();
  set_points(model, mesh, face, options.subdivision);
  return model;
}

}  // namespace microslip::truth
