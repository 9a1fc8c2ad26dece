#include "fem/stress_jumps.hpp"

#include <iostream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "fem/modal_analysis.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::fem::test_stress_jumps {
namespace {

using mesh::ElementType;

const Material titanium{1.14e11, 0.32, 4430.0};
constexpr Eigen::Index n_modes = 4;

Eigen::Vector3d bend(const Eigen::Vector3d& x) {
  return {x[0], x[1] + 3.0 * x[0] * x[0], x[2] * (1.0 - 2.0 * x[0])};
}

/// @param fine  cells for each of the coarsest.
mesh::Mesh bar(ElementType type, int fine) {
  return test::box_mesh(type,
                        {.size = {0.1, 0.02, 0.015}, .cells = {4 * fine, fine, fine}, .map = bend});
}

ModalBasis modes_of(const mesh::Mesh& mesh) {
  return Structure(mesh, titanium, {"x0"}).solve_modes({.n_modes = n_modes});
}

const ModalBasis& finest() {
  static const ModalBasis basis = modes_of(bar(ElementType::hex20, 6));
  return basis;
}

class ExcessOf : public testing::TestWithParam<ElementType> {};

TEST_P(ExcessOf, AHeldBarIsOfTheSizeOfItsError) {
  const int fine = mesh::is_quadratic(GetParam()) ? 2 : 4;
  const mesh::Mesh mesh = bar(GetParam(), fine);
  const ModalBasis basis = modes_of(mesh);
  const Eigen::VectorXd told = frequency_excess(mesh, titanium, basis.shapes);
  ASSERT_EQ(told.size(), n_modes);
  for (Eigen::Index i = 0; i < n_modes; ++i) {
    const double error = 1.0 - finest().frequency[i] / basis.frequency[i];
    std::cout << name(GetParam()) << " mode " << i + 1 << ": error " << error << ", told "
              << told[i] / error << " of it\n";
    EXPECT_GT(told[i], 0.4 * error);
    EXPECT_LT(told[i], 2.5 * error);
  }
}

TEST_P(ExcessOf, UniformStrainIsNone) {
  const mesh::Mesh mesh = bar(GetParam(), 2);
  Eigen::MatrixXd shapes(3 * mesh.n_nodes(), 1);
  Eigen::Matrix3d gradient;
  gradient << 1.0, 0.3, -0.2, 0.5, -0.7, 0.1, 0.9, 0.4, 0.2;
  for (Eigen::Index i = 0; i < mesh.n_nodes(); ++i) {
    shapes.col(0).segment<3>(3 * i) = gradient * mesh.nodes().row(i).transpose();
  }
  EXPECT_LT(frequency_excess(mesh, titanium, shapes)[0], 1e-20);
}

TEST_P(ExcessOf, NeitherScaleNorUnitsMatter) {
  const mesh::Mesh mesh = bar(GetParam(), 1);
  const ModalBasis basis = modes_of(mesh);
  const Eigen::VectorXd told = frequency_excess(mesh, titanium, basis.shapes);
  const Material other{1.0, titanium.poissons_ratio, 1.0};
  const Eigen::VectorXd again = frequency_excess(mesh, other, 1e9 * basis.shapes);
  EXPECT_LT((again - told).cwiseAbs().maxCoeff(), 1e-10 * told.maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(StressJumps, ExcessOf,
                         testing::Values(ElementType::tet4, ElementType::tet10, ElementType::hex8,
                                         ElementType::hex20, ElementType::wedge6,
                                         ElementType::wedge15, ElementType::pyramid5,
                                         ElementType::pyramid13),
                         [](const auto& one) { return std::string(name(one.param)); });

TEST(StressJumps, WhatDoesNotMoveHasNone) {
  const mesh::Mesh mesh = bar(ElementType::hex8, 1);
  const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(3 * mesh.n_nodes(), 1);
  EXPECT_EQ(frequency_excess(mesh, titanium, still)[0], 0.0);
}

TEST(StressJumps, OtherRowsAreRefused) {
  const mesh::Mesh mesh = bar(ElementType::hex8, 1);
  EXPECT_THROW(static_cast<void>(frequency_excess(mesh, titanium, Eigen::MatrixXd::Zero(3, 1))),
               std::invalid_argument);
}

}  // namespace
}  // namespace microslip::fem::test_stress_jumps
