// What is hard: a trailing edge of 50 µm, and elements of which one is 20 times as long as its
// neighbour (row 31): stiffnesses that differ by nine orders of magnitude in one matrix, in which a
// Krylov method may miss modes or leave residuals. Met in: blades meshed as they are drawn. Right:
// every pair satisfies K φ = ω² M φ with matrices that were put together elsewhere, and as many
// modes lie below the last as the inertia of the factorisation counts.

#include <string>

#include <gtest/gtest.h>

#include "fem/modal_analysis.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"

namespace microslip::fem::thin_edges {
namespace {

using mesh::ElementType;

const Material steel{2.1e11, 0.3, 7800.0};
constexpr double span = 0.08;
constexpr double chord = 0.04;
constexpr double leading = 2e-3;  // thickness there
constexpr double trailing = 5e-5;
constexpr double jump = 20.0;  // of the length of elements, in the middle of the cells

/// From the unit cube: thin towards y = 1, where elements are short as well.
Eigen::Vector3d blade(const Eigen::Vector3d& x) {
  const double coarse = jump / (jump + 1.0);
  const double y =
      x.y() < 0.5 ? 2.0 * coarse * x.y() : coarse + (1.0 - coarse) * (2.0 * x.y() - 1.0);
  return {span * x.x(), chord * y, (x.z() - 0.5) * (leading + (trailing - leading) * y)};
}

class ThinEdgesHard : public testing::TestWithParam<ElementType> {};

TEST_P(ThinEdgesHard, EveryPairIsOneAndNoneIsMissed) {
  const mesh::Mesh mesh =
      test::straight_box_mesh(GetParam(), {.size = {1, 1, 1}, .cells = {5, 4, 1}, .map = blade});
  constexpr Eigen::Index n = 12;
  Structure structure(mesh, steel, {"x0"});
  const ModalBasis basis = structure.solve_modes({.n_modes = n});
  const test::DenseSystem dense = test::dense_system(mesh, steel, {"x0"});
  const Eigen::MatrixXd Phi = dense.reduce(basis.shapes);
  EXPECT_LT(
      (Phi.transpose() * dense.M * Phi - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(),
      1e-10);
  // Rounding of a matrix whose largest eigenvalue is 1e9 times that of a mode leaves 1e-16 times
  // that in its force.
  const Eigen::VectorXd exact = dense.eigenvalues();
  const double rounding = 1e-16 * exact.tail(1)[0];
  for (Eigen::Index k = 0; k < n; ++k) {
    const double square = basis.frequency[k] * basis.frequency[k];
    const Eigen::VectorXd inertia = square * dense.M * Phi.col(k);
    const double residual = (dense.K * Phi.col(k) - inertia).norm() / inertia.norm();
    EXPECT_LT(residual, 1e-8 + rounding / square) << k;
    EXPECT_LT(basis.residual[k], 1e-8 + rounding / square) << k;
    EXPECT_NEAR(square, exact[k], 1e-8 * square + 10.0 * rounding) << k;
  }
  EXPECT_GT(exact.tail(1)[0], 1e8 * exact[0]) << "not hard";
  EXPECT_EQ(basis.inertia_count, n);
  const double between = 0.5 * (exact[n - 1] + exact[n]);
  EXPECT_EQ((exact.array() < between).count(), basis.inertia_count);
}

INSTANTIATE_TEST_SUITE_P(Types, ThinEdgesHard,
                         testing::Values(ElementType::tet10, ElementType::hex20),
                         [](const auto& type) { return std::string(mesh::name(type.param)); });

}  // namespace
}  // namespace microslip::fem::thin_edges
