// Six rigid-body modes of a free body: three translations and three rotations strain nothing,
//
//   K R = 0,   R = [e₁ e₂ e₃, e₁ × x, e₂ × x, e₃ × x],
//
// and nothing else does. Boxes of curved and distorted elements of each type and of all together,
// and the default blade.
//
// Source: Géradin & Rixen, Mechanical Vibrations (2015), section 2.2 (free–free systems). Every
// element type holds R exactly, also where it is curved (isoparametric), so that only rounding is
// left: of K, ε‖K‖ against its elastic part, about 1e-16 λ_max/λ_7 ≤ 1e-10 here, and 1e-8 is asked
// of the space.
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include "fem/modal_analysis.hpp"
#include "fem/slepc_session.hpp"
#include "mesh/mesh_reader.hpp"
#include "mesh/mesher_process.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"
#include "tests/support/temporary_folder.hpp"

namespace microslip::rigid_body_modes {
namespace {

using mesh::ElementType;

const fem::Material titanium{1.14e11, 0.32, 4430.0};

mesh::Mesh distorted_box(ElementType type) {
  return test::box_mesh(type,
                        {.size = {1.0, 0.6, 0.4}, .cells = {3, 2, 2}, .map = test::distorted});
}

mesh::Mesh default_blade() {
  const test::TemporaryFolder folder;
  mesh::mesh_blade({}, {0.008}, folder.path() / "blade.msh");
  return mesh::read_gmsh(folder.path() / "blade.msh");
}

/// Orthonormal columns that span what the given ones span.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& X) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(X).householderQ() *
         Eigen::MatrixXd::Identity(X.rows(), X.cols());
}

/// Translations and rotations of all nodes, lengths measured in the size of the body.
Eigen::MatrixXd rigid_motions(const mesh::Mesh& mesh) {
  const Eigen::Vector3d centre = 0.5 * (mesh.lower() + mesh.upper());
  const double size = (mesh.upper() - mesh.lower()).norm();
  Eigen::MatrixXd R(3 * mesh.n_nodes(), 6);
  for (Eigen::Index node = 0; node < mesh.n_nodes(); ++node) {
    const Eigen::Vector3d x = (mesh.nodes().row(node).transpose() - centre) / size;
    for (int axis = 0; axis < 3; ++axis) {
      R.block<3, 1>(3 * node, axis) = Eigen::Vector3d::Unit(axis);
      R.block<3, 1>(3 * node, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(x);
    }
  }
  return R;
}

/// Sine of the largest angle between the spaces of two sets of columns.
double distance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd P = orthonormal(A);
  const Eigen::MatrixXd Q = orthonormal(B);
  return (P - Q * (Q.transpose() * P)).norm();
}

void expect_six_rigid_modes(const mesh::Mesh& mesh, const char* name) {
  fem::Structure structure(mesh, titanium, {});
  const fem::ModalBasis basis = structure.solve_modes({.n_modes = 8});
  const double error = distance(basis.shapes.leftCols(6), rigid_motions(mesh));
  std::printf(
      "%-15s rigid-body modes: %td (6 expected); inertia count up to mode 8: %td (8); mode 7: %.2f "
      "Hz; "
      "space against R: %.1e (below 1e-8)\n",
      name, basis.n_rigid_body, basis.inertia_count, basis.frequency[6] / (2.0 * std::numbers::pi),
      error);
  EXPECT_EQ(basis.n_rigid_body, 6);
  EXPECT_EQ(basis.frequency.head(6), Eigen::VectorXd::Zero(6));
  EXPECT_GT(basis.frequency[6], 0.0);
  EXPECT_EQ(basis.inertia_count, 8);
  EXPECT_LT(error, 1e-8);
}

class RigidBodyModes : public testing::TestWithParam<ElementType> {};

// The eigenvalues of the full matrices, by a solver that knows nothing of rigid bodies.
TEST_P(RigidBodyModes, AreTheSixZerosOfTheFullMatrices) {
  const mesh::Mesh mesh = distorted_box(GetParam());
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {});
  const Eigen::VectorXd values = dense.eigenvalues();
  const Eigen::MatrixXd R = orthonormal(rigid_motions(mesh));
  const double force = (dense.K * R).norm() / dense.K.norm();
  std::printf(
      "%-9s |lambda_6| / lambda_7: %.1e (below 1e-10); ||K R|| / ||K||: %.1e (below 1e-13)\n",
      mesh::name(GetParam()), values.head(6).cwiseAbs().maxCoeff() / values[6], force);
  EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-10 * values[6]);
  EXPECT_LT(force, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Types, RigidBodyModes, testing::ValuesIn(mesh::all_element_types),
                         [](const auto& type) { return std::string(mesh::name(type.param)); });

TEST(RigidBodyModes, AreFoundAndSpanTranslationsAndRotations) {
  const mesh::Mesh blade =
      default_blade();              // before PETSc is opened: the mesher is a child process
  const fem::SlepcSession session;  // one per process
  for (const ElementType type : mesh::all_element_types) {
    expect_six_rigid_modes(distorted_box(type), mesh::name(type));
  }
  for (const int order : {1, 2}) {
    expect_six_rigid_modes(
        test::mixed_box_mesh(order,
                             {.size = {1.0, 0.6, 0.4}, .cells = {4, 2, 2}, .map = test::distorted}),
        order == 1 ? "mixed linear" : "mixed quadratic");
  }
  expect_six_rigid_modes(blade, "blade");
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RigidBodyModes, AreReportedByTheProgramForASceneWithoutSupports) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "free.toml") << R"([model]
kind = "blade"
element_size = "8 mm"
[material]
youngs_modulus = "114 GPa"
poissons_ratio = 0.32
density = 4430
[modes]
count = 8
)";
  const std::string at = folder.path().string();
  const int status = std::system(("'" MICROSLIP_PROGRAM "' modes '" + at + "/free.toml' -o '" + at +
                                  "/run' > '" + at + "/out' 2> '" + at + "/err'")
                                     .c_str());
  ASSERT_TRUE(WIFEXITED(status));
  const std::string err = content_of(folder.path() / "err");
  EXPECT_EQ(WEXITSTATUS(status), 0) << err;
  EXPECT_NE(err.find("6 rigid-body modes"), std::string::npos) << err;
  std::ifstream table(folder.path() / "run" / "modes.csv");
  std::string line;
  std::getline(table, line);
  for (int mode = 1; mode <= 7; ++mode) {
    ASSERT_TRUE(std::getline(table, line)) << "mode " << mode;
    const double hertz = std::stod(line.substr(line.find(',') + 1));
    if (mode <= 6) {
      EXPECT_EQ(hertz, 0.0) << line;
    } else {
      EXPECT_GT(hertz, 0.0) << line;
    }
  }
}

}  // namespace
}  // namespace microslip::rigid_body_modes
