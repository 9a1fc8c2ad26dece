// The iterative way against the direct one: modes, static solutions, attachment shapes of the same
// bodies.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "fem/modal_analysis.hpp"
#include "fem/petsc_error.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::fem::test_iterative {
namespace {

using mesh::ElementType;

const Material titanium{1.14e11, 0.32, 4430.0};

Eigen::Vector3d twisted(const Eigen::Vector3d& x) {
  const double angle = 5.0 * x[0];
  return {x[0], x[1] * std::cos(angle) - x[2] * std::sin(angle),
          x[1] * std::sin(angle) + x[2] * std::cos(angle)};
}

/// Slender, twisted, of several levels: some 1800 unknowns.
const mesh::Mesh& blade() {
  static const mesh::Mesh mesh = test::box_mesh(
      ElementType::tet10, {.size = {0.12, 0.04, 0.006}, .cells = {10, 4, 1}, .map = twisted});
  return mesh;
}

Structure solved_by(SolverKind kind, const std::vector<std::string>& clamped) {
  return {blade(), titanium, clamped, Tet10Rule::accurate, kind};
}

/// Largest distance of each shape from the same of the other basis, whatever its sign,
/// over its size.
double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    const double apart = std::min((a.col(j) - b.col(j)).norm(), (a.col(j) + b.col(j)).norm());
    largest = std::max(largest, apart / b.col(j).norm());
  }
  return largest;
}

class Solutions : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Solutions, HaveTheModesOfTheDirectWay) {
  const ModalBasis direct = solved_by(SolverKind::direct, GetParam()).solve_modes({.n_modes = 12});
  const ModalBasis iterative =
      solved_by(SolverKind::iterative, GetParam()).solve_modes({.n_modes = 12});
  EXPECT_EQ(iterative.n_rigid_body, direct.n_rigid_body);
  const Eigen::Index n = 12 - direct.n_rigid_body;
  const Eigen::VectorXd exact = direct.frequency.tail(n);
  // Residuals of 1e-8 leave errors of frequencies of their squares.
  EXPECT_LT((iterative.frequency.tail(n) - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(largest_difference(iterative.shapes.rightCols(n), direct.shapes.rightCols(n)), 1e-6);
  EXPECT_EQ(iterative.inertia_count, -1);  // that none is missed is not proved
  EXPECT_GT(direct.inertia_count, 0);
}

TEST_P(Solutions, HaveTheStaticShapesOfTheDirectWay) {
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * blade().n_nodes(), 1);
  force(3 * blade().node_set("corner").front() + 2) = 1.0;
  const mesh::Surface& face = blade().surface("x1");
  const Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  const auto attached = [&](SolverKind kind) {
    Structure structure = solved_by(kind, GetParam());
    const ModalBasis basis = structure.solve_modes({.n_modes = 10});
    AttachmentOptions options;
    options.degree = 1;
    return structure.attach(basis, {{face, frame}}, force, options).basis;
  };
  const ModalBasis direct = attached(SolverKind::direct);
  const ModalBasis iterative = attached(SolverKind::iterative);
  ASSERT_EQ(iterative.n_attachment, direct.n_attachment);
  const Eigen::Index n = direct.n_attachment;
  const Eigen::VectorXd exact = direct.frequency.tail(n);
  EXPECT_LT((iterative.frequency.tail(n) - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(HeldAndFree, Solutions,
                         testing::Values(std::vector<std::string>{"x0"},
                                         std::vector<std::string>{}));

TEST(IterativeSolution, OfStaticLoadsIsThatOfTheDirectWay) {
  const Eigen::MatrixXd loads = Eigen::MatrixXd::Random(3 * blade().n_nodes(), 2);
  const Eigen::MatrixXd exact = solved_by(SolverKind::direct, {"x0"}).solve_static(loads);
  const Eigen::MatrixXd u = solved_by(SolverKind::iterative, {"x0"}).solve_static(loads);
  // The residual is 1e-10 of the load; displacements feel it by the condition of K, 1e6, of smooth
  // parts.
  EXPECT_LT((u - exact).norm(), 1e-6 * exact.norm());
}

class Elements : public testing::TestWithParam<ElementType> {};

/// Thin, where corners alone are far too stiff in bending.
TEST_P(Elements, OfAPlateHaveTheSolutionOfTheDirectWay) {
  const mesh::Mesh plate =
      test::box_mesh(GetParam(), {.size = {1.0, 1.0, 0.02}, .cells = {6, 6, 1}, .map = {}});
  const Eigen::MatrixXd load = Eigen::MatrixXd::Random(3 * plate.n_nodes(), 1);
  const auto solved = [&](SolverKind kind) {
    return Structure(plate, titanium, {"x0"}, Tet10Rule::accurate, kind).solve_static(load);
  };
  const Eigen::MatrixXd exact = solved(SolverKind::direct);
  EXPECT_LT((solved(SolverKind::iterative) - exact).norm(), 1e-6 * exact.norm());
}

INSTANTIATE_TEST_SUITE_P(AllTypes, Elements, testing::ValuesIn(mesh::all_element_types));

/// One layer between two held sides: free are nodes in the middle of edges alone.
TEST(IterativeSolution, NeedsNoFreeCorner) {
  const mesh::Mesh layer =
      test::box_mesh(ElementType::hex20, {.size = {1.0, 1.0, 0.1}, .cells = {3, 3, 1}, .map = {}});
  const Eigen::MatrixXd load = Eigen::MatrixXd::Random(3 * layer.n_nodes(), 1);
  const auto solved = [&](SolverKind kind) {
    return Structure(layer, titanium, {"z0", "z1"}, Tet10Rule::accurate, kind).solve_static(load);
  };
  const Eigen::MatrixXd exact = solved(SolverKind::direct);
  ASSERT_GT(exact.norm(), 0.0);
  EXPECT_LT((solved(SolverKind::iterative) - exact).norm(), 1e-6 * exact.norm());
}

TEST(IterativeSolution, OfABodyWithAMechanismIsRefused) {
  // Held along one edge: hinged. The levels are set up for a singular matrix.
  const mesh::Mesh mesh =
      test::box_mesh(ElementType::hex8, {.size = {1, 1, 1}, .cells = {2, 2, 2}, .map = {}});
  Structure structure(mesh, titanium, {"corner"}, Tet10Rule::accurate, SolverKind::iterative);
  EXPECT_THROW(
      static_cast<void>(structure.solve_static(Eigen::MatrixXd::Ones(3 * mesh.n_nodes(), 1))),
      EigenError);  // rigid-body: told before
}

}  // namespace
}  // namespace microslip::fem::test_iterative
