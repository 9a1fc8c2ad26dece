#include "contact/patch/contact_area.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>

#include "contact/surface/surface_law.hpp"

namespace microslip::contact {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

Eigen::VectorXd random_vector(std::mt19937_64& random, Eigen::Index n) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(random); });
}

ContactArea random_area(std::mt19937_64& random, Eigen::Index n) {
  return ContactArea(
      {random_vector(random, n), random_vector(random, n), random_vector(random, n).cwiseAbs()});
}

TEST(ContactArea, GridHasItsCentresAndItsArea) {
  const PlanarCells cells = rectangle_cells(0.2, 0.3, 2, 3);
  ASSERT_EQ(cells.weights.size(), 6);
  EXPECT_NEAR(cells.weights.sum(), 0.06, 4.0 * eps);
  EXPECT_EQ(cells.y[0], -0.05);
  EXPECT_EQ(cells.y[5], 0.05);
  EXPECT_NEAR(cells.z[0], -0.1, eps);
  EXPECT_EQ(cells.z[1], 0.0);
  EXPECT_EQ(cells.y.sum(), 0.0);
  EXPECT_THROW((void)rectangle_cells(0.0, 1.0, 1, 1), std::invalid_argument);
  EXPECT_THROW((void)rectangle_cells(1.0, 1.0, 1, 0), std::invalid_argument);
}

// u_i = u + φ × r_i and M = Σ r_i × F_i with vectors.
TEST(ContactArea, CellsMoveAsARigidPlaneAndForcesAddUp) {
  std::mt19937_64 random(1);
  const ContactArea area = random_area(random, 7);
  const AreaVector U = random_vector(random, 6);
  const Eigen::Matrix3Xd motions = area.cell_motions(U);
  const Eigen::Matrix3Xd tractions =
      Eigen::Matrix3Xd::NullaryExpr(3, 7, [&] { return random_vector(random, 1)[0]; });
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < 7; ++i) {
    const Eigen::Vector3d arm(0.0, area.cells().y[i], area.cells().z[i]);
    const Eigen::Vector3d expected = U.head<3>() + U.tail<3>().cross(arm);
    EXPECT_LE((motions.col(i) - expected).norm(), 8.0 * eps);
    const Eigen::Vector3d f = area.cells().weights[i] * tractions.col(i);
    force += f;
    moment += arm.cross(f);
  }
  const AreaVector resultant = area.resultant(tractions);
  // Sums of 7 to 14 products below one.
  EXPECT_LE((resultant.head<3>() - force).norm(), 20.0 * eps);
  EXPECT_LE((resultant.tail<3>() - moment).norm(), 20.0 * eps);
}

TEST(ContactArea, VirtualWorkIsTheSameInCellsAndAtTheCentre) {
  std::mt19937_64 random(2);
  for (int sample = 0; sample < 100; ++sample) {
    const ContactArea area = random_area(random, 11);
    const AreaVector U = random_vector(random, 6);
    const Eigen::Matrix3Xd tractions =
        Eigen::Matrix3Xd::NullaryExpr(3, 11, [&] { return random_vector(random, 1)[0]; });
    const double in_cells =
        (area.cell_motions(U).cwiseProduct(tractions) * area.cells().weights).sum();
    EXPECT_NEAR(area.resultant(tractions).dot(U), in_cells,
                100.0 * eps);  // 33 products of size one
  }
}

// The same contact seen from the other body: the frame turned by 180° about z, so that x leaves
// that body, and its motion relative to the first. It must feel the opposite force and moment.
TEST(ContactArea, ActionIsReaction) {
  std::mt19937_64 random(3);
  const ContactArea area = random_area(random, 9);
  const ContactArea turned({-area.cells().y, area.cells().z, area.cells().weights});
  const AreaVector U = random_vector(random, 6);
  const AreaVector turn = (AreaVector() << -1, -1, 1, -1, -1, 1).finished();
  const auto force = [](const ContactArea& on, const AreaVector& motion) {
    Eigen::Matrix3Xd t = on.cell_motions(motion);
    t.row(0) = t.row(0).cwiseMax(0.0);  // no pull
    return on.resultant(Eigen::Vector3d(3.0, 2.0, 1.0).asDiagonal() * t);
  };
  const AreaVector action = force(area, U);
  const AreaVector reaction = turn.cwiseProduct(force(turned, turn.cwiseProduct(-U)));
  EXPECT_LE((action + reaction).norm(), 50.0 * eps);  // sums of 27 products of size one
  EXPECT_GT(action.norm(), 1.0);
}

// The tangent of rough one-sided cells with tangential springs that follow the load, part of the
// cells lifted off, against differences.
TEST(ContactArea, TangentIsTheDerivativeOfForceAndMoment) {
  const ContactArea area(rectangle_cells(0.1, 0.06, 5, 4));
  const SurfaceLaw law({1e12, 2e12, 0.4, 0.0}, 1.5e12, FrictionLaw::constant(0.4),
                       RoughSurface::cubic(1e-6));
  const auto tractions = [&](const AreaVector& U) {
    Eigen::Matrix3Xd t = area.cell_motions(U);
    for (Eigen::Index i = 0; i < t.cols(); ++i) {
      const SurfaceState s = law.at(t(0, i), 0.0);
      t.col(i) =
          Eigen::Vector3d(s.load, law.second_stiffness() * s.second_stiffness_ratio * t(1, i),
                          law.first_stiffness() * s.stiffness_ratio * t(2, i));
    }
    return t;
  };
  const AreaVector U = (AreaVector() << 0.3e-6, 0.2e-6, -0.1e-6, 1e-5, 2e-5, -1.3e-5).finished();
  std::vector<Eigen::Matrix3d> stiffness;
  int lifted = 0;
  for (Eigen::Index i = 0; i < area.n_cells(); ++i) {
    const Eigen::Vector3d u = area.cell_motions(U).col(i);
    const SurfaceState s = law.at(u[0], 0.0);
    lifted += s.load == 0.0 ? 1 : 0;
    Eigen::Matrix3d k = Eigen::Matrix3d::Zero();
    k(0, 0) = s.load_by_approach;
    k(1, 1) = law.second_stiffness() * s.second_stiffness_ratio;
    k(1, 0) = law.second_stiffness() * s.second_stiffness_ratio_by_approach * u[1];
    k(2, 2) = law.first_stiffness() * s.stiffness_ratio;
    k(2, 0) = law.first_stiffness() * s.stiffness_ratio_by_approach * u[2];
    stiffness.push_back(k);
  }
  EXPECT_GT(lifted, 3);
  EXPECT_LT(lifted, 17);
  const AreaStiffness K = area.tangent(stiffness);
  for (int column = 0; column < 6; ++column) {
    const double h = column < 3 ? 1e-10 : 1e-9;  // 1e-4 of the height of the asperities
    AreaVector step = AreaVector::Zero();
    step[column] = h;
    const AreaVector difference =
        (area.resultant(tractions(U + step)) - area.resultant(tractions(U - step))) / (2.0 * h);
    // h² = 1e-8 of third derivatives of size 6 per cell; relative to the largest entries of a
    // block.
    EXPECT_LE((difference - K.col(column)).norm(), 1e-6 * K.col(column).norm()) << column;
  }
}

TEST(ContactArea, ModalShapesAreInTheLettersOfThePatch) {
  std::mt19937_64 random(4);
  const ContactArea area = random_area(random, 3);
  const Eigen::MatrixXd modes =
      Eigen::MatrixXd::NullaryExpr(6, 2, [&] { return random_vector(random, 1)[0]; });
  const ModalShapes shapes = area.modal_shapes(modes);
  for (Eigen::Index mode = 0; mode < 2; ++mode) {
    const Eigen::Matrix3Xd motions = area.cell_motions(modes.col(mode));
    EXPECT_LE((shapes.v.col(mode) - motions.row(0).transpose()).norm(), 8.0 * eps);
    EXPECT_LE((shapes.w.col(mode) - motions.row(1).transpose()).norm(), 8.0 * eps);
    EXPECT_LE((shapes.u.col(mode) - motions.row(2).transpose()).norm(), 8.0 * eps);
  }
  EXPECT_THROW((void)area.modal_shapes(Eigen::MatrixXd::Zero(5, 2)), std::invalid_argument);
}

TEST(ContactArea, RefusesCellsThatAreNone) {
  const Eigen::VectorXd two = Eigen::VectorXd::Ones(2);
  EXPECT_THROW(ContactArea({two, two, Eigen::VectorXd::Ones(3)}), std::invalid_argument);
  EXPECT_THROW(ContactArea({two, two, Eigen::VectorXd::Zero(2)}), std::invalid_argument);
  EXPECT_THROW(ContactArea({two, two, Eigen::Vector2d(1.0, -1.0)}), std::invalid_argument);
  EXPECT_THROW(ContactArea({two, Eigen::Vector2d(0.0, std::nan("")), two}), std::invalid_argument);
  EXPECT_THROW(ContactArea({Eigen::VectorXd(0), Eigen::VectorXd(0), Eigen::VectorXd(0)}),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::contact
