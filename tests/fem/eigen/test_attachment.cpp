// Attachment shapes (theory section 14.1) against full matrices.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include "fem/elements/polynomial_tractions.hpp"
#include "fem/modal_analysis.hpp"
#include "fem/surface_load.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"

namespace microslip::fem::test_attachment {
namespace {

using mesh::ElementType;

const Material titanium{1.14e11, 0.32, 4430.0};
const Eigen::Vector3d springs{3e12, 1e12, 3e12};  // [N/m³], as stiff as the bar below the face

mesh::Mesh bar(int along_y = 2) {
  return test::box_mesh(ElementType::tet10,
                        {.size = {0.1, 0.02, 0.015}, .cells = {3, along_y, 1}, .map = {}});
}

// Rows p, q, r for the side y1 of the bar, p turned from x by an angle.
Eigen::Matrix3d side_frame(double angle = 0.0) {
  Eigen::Matrix3d frame;
  frame.row(0) = Eigen::RowVector3d(std::cos(angle), 0.0, -std::sin(angle));
  frame.row(1) = Eigen::RowVector3d::UnitY();
  frame.row(2) = frame.row(0).cross(frame.row(1));
  return frame;
}

Eigen::MatrixXd two_forces(const mesh::Mesh& mesh) {
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), 2);
  const Eigen::Index corner = mesh.node_set("corner").front();
  F(3 * corner, 0) = 3.0;
  F(3 * corner + 1, 1) = 1e-6;  // sizes of loads must not matter
  return F;
}

double relative(const Eigen::MatrixXd& computed, const Eigen::MatrixXd& exact) {
  return (computed - exact).norm() / exact.norm();
}

/// Φ Ω⁻² ΦᵀF over the elastic columns: the static answer of a basis.
Eigen::MatrixXd static_answer(const ModalBasis& basis, const Eigen::MatrixXd& F) {
  const Eigen::Index n = basis.frequency.size() - basis.n_rigid_body;
  const Eigen::MatrixXd Phi = basis.shapes.rightCols(n);
  return Phi * basis.frequency.tail(n).cwiseAbs2().cwiseInverse().asDiagonal() *
         (Phi.transpose() * F);
}

TEST(Attachment, ShapesAreOrthonormalInMassAndDiagonalInStiffness) {
  const mesh::Mesh mesh = bar();
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {"x0"});
  Structure structure(mesh, titanium, {"x0"});
  const ModalBasis modes = structure.solve_modes({.n_modes = 5});
  for (const int degree : {0, 1, 3}) {
    const AttachedBasis attached = structure.attach(modes, {{mesh.surface("y1"), side_frame()}},
                                                    two_forces(mesh), {.degree = degree});
    const ModalBasis& basis = attached.basis;
    EXPECT_EQ(basis.n_free(), 5);
    EXPECT_EQ(basis.n_attachment + attached.n_dropped, 3 * n_polynomials(degree) + 2);
    EXPECT_EQ(attached.n_dropped, 0);
    const Eigen::MatrixXd Phi = dense.reduce(basis.shapes);
    const Eigen::Index n = Phi.cols();
    EXPECT_LT((Phi.transpose() * dense.M * Phi - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-9);
    const Eigen::VectorXd scale = basis.frequency.cwiseInverse();
    const Eigen::MatrixXd K =
        scale.asDiagonal() * (Phi.transpose() * dense.K * Phi) * scale.asDiagonal();
    EXPECT_LT((K - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-7);  // φᵀKψ by the eigenpairs' 1e-8
    EXPECT_EQ(basis.shapes.leftCols(5), modes.shapes);
    EXPECT_GT(basis.frequency[5], modes.frequency[4]) << "the modes left out lie above those kept";
  }
}

TEST(Attachment, TheStaticAnswerToEveryLoadIsExact) {
  const mesh::Mesh mesh = bar();
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {"x0"});
  Structure structure(mesh, titanium, {"x0"});
  const ModalBasis modes = structure.solve_modes({.n_modes = 4});
  const Eigen::MatrixXd forces = two_forces(mesh);
  const ModalBasis basis =
      structure.attach(modes, {{mesh.surface("y1"), side_frame(0.3)}}, forces, {.degree = 2}).basis;
  Eigen::MatrixXd F(forces.rows(), 20);
  F << polynomial_tractions(mesh.nodes(), mesh.surface("y1"), side_frame(-0.7), 2), forces;
  const Eigen::MatrixXd exact = dense.solve(F);
  const Eigen::MatrixXd computed = static_answer(basis, F);
  for (Eigen::Index j = 0; j < F.cols(); ++j)
    EXPECT_LT(relative(computed.col(j), exact.col(j)), 1e-8) << j;
  EXPECT_GT(relative(static_answer(modes, F), exact), 1e-3) << "the modes alone are not";
}

// Inertia relief: the elastic part of the answer, all modes but the rigid ones.
TEST(Attachment, AFreeBodyAnswersElasticallyWithoutError) {
  const mesh::Mesh mesh = bar(1);
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {});
  Structure structure(mesh, titanium, {});
  const test::PencilPairs eigen = test::pencil_pairs(dense.K, dense.M);
  const Eigen::Index n_elastic = eigen.values.size() - 6;
  const Eigen::MatrixXd Phi = eigen.vectors.rightCols(n_elastic);
  for (const Eigen::Index n : {6, 9}) {
    const ModalBasis modes = structure.solve_modes({.n_modes = n});
    const Eigen::MatrixXd F =
        polynomial_tractions(mesh.nodes(), mesh.surface("y1"), side_frame(), 1);
    const ModalBasis basis = structure
                                 .attach(modes, {{mesh.surface("y1"), side_frame()}},
                                         Eigen::MatrixXd(F.rows(), 0), {.degree = 1})
                                 .basis;
    const Eigen::MatrixXd exact = Phi * eigen.values.tail(n_elastic).cwiseInverse().asDiagonal() *
                                  (Phi.transpose() * dense.reduce(F));
    EXPECT_LT(relative(static_answer(basis, F), dense.expand(exact, F.rows())), 1e-7) << n;
  }
}

TEST(Attachment, LoadsThatSayNothingNewAreLeftOut) {
  const mesh::Mesh mesh = bar();
  const mesh::Surface& side = mesh.surface("y1");
  Structure structure(mesh, titanium, {"x0"});
  const ModalBasis modes = structure.solve_modes({.n_modes = 3});
  Eigen::MatrixXd forces(3 * mesh.n_nodes(), 3);
  forces.leftCols<2>() = two_forces(mesh);
  forces.col(2) =
      7.0 * forces.col(0) + 5.0 * uniform_tractions(mesh.nodes(), side, side_frame()).col(1);
  const AttachedBasis attached =
      structure.attach(modes, {{side, side_frame()}}, forces, {.degree = 0});
  EXPECT_EQ(attached.n_dropped, 1);
  EXPECT_EQ(attached.basis.n_attachment, 5);
  forces.col(2).setZero();
  EXPECT_EQ(structure.attach(modes, {{side, side_frame()}}, forces, {.degree = 0}).n_dropped, 1);
}

/// Part of a tube of this inner radius around z.
mesh::Mesh tube(double angle, double length, int n_cells) {
  return test::box_mesh(mesh::ElementType::hex20,
                        {{1.0, 1.0, 1.0}, {1, n_cells, 1}, [=](const Eigen::Vector3d& x) {
                           const double r = 0.03 + 0.01 * x[0];
                           return Eigen::Vector3d(r * std::cos(angle * x[1]),
                                                  r * std::sin(angle * x[1]), length * x[2]);
                         }});
}

const mesh::FaceFrame along_the_axis(Eigen::Matrix3d::Identity().eval(), Eigen::Vector3d::UnitZ());

TEST(Attachment, TractionsOfACurvedFaceAreAlongTheAxesOfEveryPlace) {
  const mesh::Mesh mesh = tube(1.2, 0.02, 8);
  const mesh::Surface& inside = mesh.surface("x0");
  const Eigen::MatrixXd loads = polynomial_tractions(mesh.nodes(), inside, along_the_axis, 2);
  const Eigen::MatrixX3d uniform = uniform_tractions(mesh.nodes(), inside, along_the_axis);
  // The root in dA of a curved face is no polynomial: rules of two degrees differ by 1e-10.
  EXPECT_LT(relative(loads.leftCols<3>(), uniform / std::sqrt(inside.area)), 1e-9);
  EXPECT_LT((uniform.col(1) - normal_traction(mesh.nodes(), inside)).norm(), 1e-14);
  for (const Eigen::Index node : inside.nodes) {
    EXPECT_LT(uniform.col(0).segment<2>(3 * node).norm(), 1e-18) << "p is the axis of the tube";
    EXPECT_LT(std::abs(uniform(3 * node + 2, 2)), 1e-18) << "r goes around it";
  }
}

// An arc that is narrower than it is high: its mean plane still has the axis of the tube in it.
TEST(Attachment, TractionsOfANarrowArcTellItsEdgesApart) {
  constexpr double length = 0.002;
  const mesh::Mesh mesh = tube(1.2, length, 8);
  const mesh::Surface& inside = mesh.surface("x0");
  const Eigen::MatrixXd loads = polynomial_tractions(mesh.nodes(), inside, along_the_axis, 1);
  Eigen::VectorXd tilt = Eigen::VectorXd::Zero(loads.rows());  // (z − z̄) e_p
  for (const Eigen::Index node : inside.nodes) {
    tilt[3 * node + 2] = mesh.nodes()(node, 2) - 0.5 * length;
  }
  const Eigen::VectorXd work = loads.transpose() * tilt;
  const double whole = std::sqrt(inside.area * length * length / 12.0);
  EXPECT_NEAR(std::hypot(work[3], work[6]), whole, 1e-9 * whole);
}

TEST(Attachment, TractionsThatDependOnOthersOnAClosedFaceAreZero) {
  const mesh::Mesh mesh = tube(5.9, 0.02, 32);
  const mesh::Surface& inside = mesh.surface("x0");
  const Eigen::MatrixXd loads = polynomial_tractions(mesh.nodes(), inside, along_the_axis, 3);
  ASSERT_TRUE(loads.allFinite());
  const Eigen::ArrayXd size = loads.colwise().norm().transpose();
  // x² + y² is a constant, times x and times y too: three polynomials of ten.
  EXPECT_EQ((size == 0.0).count(), 9);
  EXPECT_GT((size != 0.0).select(size, size.maxCoeff()).minCoeff(), 0.1 * size.maxCoeff());
}

TEST(Attachment, TractionsAreOrthonormalAndTheirSpanDoesNotKnowTheAxes) {
  const mesh::Mesh mesh = bar();
  const mesh::Surface& side = mesh.surface("y1");
  const Eigen::MatrixXd straight = polynomial_tractions(mesh.nodes(), side, side_frame(), 3);
  const Eigen::MatrixXd turned = polynomial_tractions(mesh.nodes(), side, side_frame(1.1), 3);
  EXPECT_EQ(straight.cols(), 30);
  for (const int degree : {0, 1, 2, 3}) {
    const Eigen::Index n = 3 * n_polynomials(degree);
    const Eigen::MatrixXd Q = straight.leftCols(n).householderQr().householderQ() *
                              Eigen::MatrixXd::Identity(straight.rows(), n);
    const Eigen::MatrixXd rest = turned.leftCols(n) - Q * (Q.transpose() * turned.leftCols(n));
    EXPECT_LT(rest.norm(), 1e-12 * turned.norm()) << degree;
  }
  const Eigen::MatrixX3d uniform = uniform_tractions(mesh.nodes(), side, side_frame());
  EXPECT_LT(relative(straight.leftCols<3>(), uniform / std::sqrt(side.area)), 1e-12);
  // Work on a displacement x e_q of the face: ∫ t x dA, for t normal and linear in x alone √(∫ (x −
  // x̄)² dA).
  Eigen::VectorXd tilt = Eigen::VectorXd::Zero(straight.rows());
  for (const Eigen::Index node : side.nodes) tilt[3 * node + 1] = mesh.nodes()(node, 0);
  const Eigen::VectorXd work = straight.transpose() * tilt;
  EXPECT_NEAR(std::hypot(work[4], work[7]), std::sqrt(side.area * 0.1 * 0.1 / 12.0), 1e-12);
  EXPECT_LT(work.tail(30 - 9).norm(), 1e-14) << "orthogonal to the quadratic and cubic ones";
  EXPECT_THROW(static_cast<void>(polynomial_tractions(mesh.nodes(), side, side_frame(), -1)),
               std::invalid_argument);
}

/// s by another way: what the model with shapes up to `degree` lacks of the full K⁻¹.
double missed_by(const ModalBasis& modes, const ModalBasis& attached,
                 const test::DenseSystem& dense, const Eigen::MatrixXd& F) {
  const Eigen::MatrixXd answer = dense.solve(F);
  const Eigen::MatrixXd missed = F.transpose() * (answer - static_answer(attached, F));
  Eigen::MatrixXd whole = F.transpose() * (answer - static_answer(modes, F));
  whole.diagonal() += springs.cwiseInverse().replicate(F.cols() / 3, 1);
  const test::PencilPairs eigen =
      test::pencil_pairs(0.5 * (missed + missed.transpose()), 0.5 * (whole + whole.transpose()));
  return eigen.values.maxCoeff();
}

TEST(Attachment, TheDegreeIsTheLowestThatMissesLittleOfTheNext) {
  const mesh::Mesh mesh = bar();
  const mesh::Surface& side = mesh.surface("y1");
  const test::DenseSystem dense = test::dense_system(mesh, titanium, {"x0"});
  Structure structure(mesh, titanium, {"x0"});
  const ModalBasis modes = structure.solve_modes({.n_modes = 5});
  const Eigen::MatrixXd none(3 * mesh.n_nodes(), 0);
  std::array<double, 3> shares{};  // need not fall with every degree: each is of other tractions
  for (std::size_t degree = 0; degree < shares.size(); ++degree) {
    const int d = static_cast<int>(degree);
    const ModalBasis given =
        structure.attach(modes, {{side, side_frame()}}, none, {.degree = d}).basis;
    const Eigen::MatrixXd next =
        polynomial_tractions(mesh.nodes(), side, side_frame(), d + 1).rightCols(3 * (d + 2));
    shares[degree] = missed_by(modes, given, dense, next);
    std::printf("degree %d misses %.3e of degree %d\n", d, shares[degree], d + 1);
  }
  for (const double share : shares) {
    for (const double tolerance : {1.001 * share, 0.999 * share}) {
      const auto first = std::ranges::find_if(shares, [&](double s) { return s <= tolerance; });
      if (first == shares.end()) continue;
      for (const double angle : {0.0, 0.8}) {
        const AttachedBasis chosen =
            structure.attach(modes, {{side, side_frame(angle), springs}}, none,
                             {.degree = {}, .missed_tolerance = tolerance});
        EXPECT_EQ(chosen.degree, first - shares.begin());
        EXPECT_NEAR(chosen.missed_share, *first, 1e-6 * *first);
      }
    }
  }
  const AttachedBasis most =
      structure.attach(modes, {{side, side_frame(), springs}}, none,
                       {.degree = {}, .missed_tolerance = 0.0, .max_degree = 2});
  EXPECT_EQ(most.degree, 2);
}

TEST(Attachment, WithoutLocalStiffnessNoTractionMatters) {
  const mesh::Mesh mesh = bar();
  Structure structure(mesh, titanium, {"x0"});
  const ModalBasis modes = structure.solve_modes({.n_modes = 5});
  const AttachedBasis attached =
      structure.attach(modes, {{mesh.surface("y1"), side_frame()}}, two_forces(mesh));
  EXPECT_EQ(attached.degree, 0);
  EXPECT_EQ(attached.missed_share, 0.0);
  EXPECT_THROW(static_cast<void>(structure.attach(modes, {{mesh.surface("y1"), side_frame()}},
                                                  two_forces(mesh), {.degree = -1})),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::fem::test_attachment
