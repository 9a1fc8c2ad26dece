#include "contact/patch/contact_area.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/Geometry>

namespace microslip::contact::test_contact_area {
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

// u_i = u + φ × r_i with vectors; (2) is its transpose.
TEST(ContactArea, CellsMoveAsARigidPlane) {
  std::mt19937_64 random(1);
  for (int sample = 0; sample < 7; ++sample) {
    const Eigen::Vector<double, 6> U = random_vector(random, 6);
    const Eigen::Vector2d at = random_vector(random, 2);
    const Eigen::Vector3d arm(0.0, at[0], at[1]);
    const Eigen::Vector3d expected = U.head<3>() + U.tail<3>().cross(arm);
    EXPECT_LE((cell_matrix(at[0], at[1]) * U - expected).norm(), 8.0 * eps);
  }
}

TEST(ContactArea, ModalShapesAreInTheLettersOfThePatch) {
  std::mt19937_64 random(4);
  const ContactArea area = random_area(random, 3);
  const Eigen::MatrixXd modes =
      Eigen::MatrixXd::NullaryExpr(6, 2, [&] { return random_vector(random, 1)[0]; });
  const ModalShapes shapes = area.modal_shapes(modes);
  for (Eigen::Index mode = 0; mode < 2; ++mode) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Vector3d motion =
          cell_matrix(area.cells().y[i], area.cells().z[i]) * modes.col(mode);
      EXPECT_NEAR(shapes.v(i, mode), motion[0], 8.0 * eps);
      EXPECT_NEAR(shapes.w(i, mode), motion[1], 8.0 * eps);
      EXPECT_NEAR(shapes.u(i, mode), motion[2], 8.0 * eps);
    }
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
}  // namespace microslip::contact::test_contact_area
