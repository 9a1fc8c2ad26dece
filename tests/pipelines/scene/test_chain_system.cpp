#include "pipelines/scene/chain_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace microslip::pipelines::test_chain_system {
namespace {

TEST(ChainSystem, SpringsTieNeighboursAndTheGround) {
  const Eigen::MatrixXd K = chain_stiffness(3, Eigen::Vector4d(1.0, 2.0, 4.0, 8.0));
  Eigen::Matrix3d expected;
  expected << 3, -2, 0, -2, 6, -4, 0, -4, 12;
  EXPECT_EQ(K, expected);
  EXPECT_EQ(chain_stiffness(2, Eigen::Vector2d(1.0, 2.0)),
            (Eigen::Matrix2d() << 3, -2, -2, 2).finished());
}

TEST(ChainSystem, ModesAreThoseOfTheMatrices) {
  Eigen::Matrix3d M, K;
  M << 2, 0.3, 0, 0.3, 1, 0.1, 0, 0.1, 5;
  K << 30, -10, 0, -10, 25, -4, 0, -4, 60;
  const ChainSystem system = modes_of_matrices(K, M);
  const Eigen::MatrixXd& Phi = system.shapes;
  // A few roundings of matrices of size three.
  EXPECT_LT((Phi.transpose() * M * Phi - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  const Eigen::MatrixXd residual = K * Phi - M * Phi * system.frequency.cwiseAbs2().asDiagonal();
  EXPECT_LT(residual.norm(), 1e-13 * K.norm());
}

TEST(ChainSystem, ARigidBodyModeHasFrequencyZeroExactly) {
  const Eigen::MatrixXd K = chain_stiffness(3, Eigen::Vector3d(0.0, 4e4, 7e4));
  const ChainSystem system = modes_of_matrices(K, Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal());
  EXPECT_EQ(system.frequency[0], 0.0);
  EXPECT_GT(system.frequency[1], 0.0);
  EXPECT_NEAR(system.shapes(0, 0), 1.0 / std::sqrt(6.0), 1e-14);  // all masses move as one of 6 kg
}

TEST(ChainSystem, MatricesThatAreNoSystemAreRefused) {
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d bad = Eigen::Vector2d(1.0, -1.0).asDiagonal();
  EXPECT_THROW(static_cast<void>(modes_of_matrices(bad, one)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(modes_of_matrices(one, bad)), std::invalid_argument);
}

TEST(ChainSystem, TheChainOfPaperBHasItsFrequencies) {
  const Eigen::MatrixXd K = chain_stiffness(2, Eigen::Vector2d(41339.0, 41328.0));
  const Eigen::VectorXd hz =
      modes_of_matrices(K, Eigen::Matrix2d::Identity()).frequency / 6.283185307179586;
  EXPECT_NEAR(hz[0], 20.0, 0.05);  // printed with one decimal
  EXPECT_NEAR(hz[1], 52.4, 0.05);
}

}  // namespace
}  // namespace microslip::pipelines::test_chain_system
