// Frequencies of a cantilever of rectangular section, and how fast they converge.
//
// Stretching, ν = 0: u_x = sin((2n−1)πx/2L), u_y = u_z = 0 solves the equations of elasticity
// exactly,
//   ω_n = (2n−1) π/(2L) √(E/ρ).                                                             (1)
// Eigenvalues of elements of degree p converge with h^{2p} (Strang & Fix, An Analysis of the Finite
// Element Method, 1973, chapter 6): rate 2 for linear elements, 4 for quadratic ones. Asked: the
// rate from the two finest of three sizes within 0.3 of it; coarse meshes are not yet in the limit.
//
// Bending, ν = 0: Timoshenko's beam with shear coefficient 5/6 (Cowper, J. Appl. Mech. 33 (1966)
// 335–340, at ν = 0), solved here by the transfer matrix. The beam neglects the warping the clamp
// holds over a length of the thickness: agreement to 1e-4 is asked for L = 20 thicknesses.
// A free beam of wedges or pyramids, or of all solids in turn, bends with the same rates: a smooth
// motion, as its corners are convex and free. The rate is that of the differences of three sizes;
// the limits they head for are one, for linear elements to what is left after extrapolation.
// Frequencies of nested meshes fall towards the exact ones from above (Rayleigh).
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include "fem/modal_analysis.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::cantilever {
namespace {

using mesh::ElementType;

const fem::Material material{2.0e11, 0.0, 8000.0};

// Frequency of the mode, among the lowest, that moves most nearly along x alone. On a coarse mesh
// of tetrahedra, which has no plane of symmetry, no mode does so exactly.
double stretching_frequency(ElementType type, int n) {
  const auto uneven = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return {x[0] + 0.01 * std::sin(2.0 * std::numbers::pi * x[0] / 0.2), x[1], x[2]};
  };
  const mesh::Mesh mesh = test::straight_box_mesh(
      type, {.size = {0.2, 0.06, 0.05}, .cells = {2 * n, n, n}, .map = uneven});
  fem::Structure bar(mesh, material, {"x0"});
  const fem::ModalBasis basis = bar.solve_modes({.n_modes = 8});
  const Eigen::RowVectorXd along =
      basis.shapes(Eigen::seq(0, Eigen::last, 3), Eigen::all).colwise().squaredNorm();
  Eigen::Index stretching = 0;
  along.cwiseQuotient(basis.shapes.colwise().squaredNorm()).maxCoeff(&stretching);
  return basis.frequency[stretching];
}

struct Expected {
  ElementType type;
  double rate;
};

class Cantilever : public testing::TestWithParam<Expected> {};

TEST_P(Cantilever, StretchesAtTheExactFrequencyWithTheRateOfItsElements) {
  const double exact =
      0.5 * std::numbers::pi / 0.2 * std::sqrt(material.youngs_modulus / material.density);
  const bool is_linear = GetParam().rate < 3.0;
  const std::array<int, 3> sizes = is_linear ? std::array{2, 4, 8} : std::array{1, 2, 4};
  std::array<double, 3> error{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double computed = stretching_frequency(GetParam().type, sizes[i]);
    error[i] = computed / exact - 1.0;
    std::printf("%-9s n = %d: computed %.8f, exact %.8f, error %.2e\n", mesh::name(GetParam().type),
                sizes[i], computed, exact, error[i]);
    EXPECT_GT(error[i], -1e-11) << "below the exact frequency by more than rounding";
  }
  const double rate = std::log2(error[1] / error[2]);
  std::printf("%-9s rate %.2f, expected %.0f\n", mesh::name(GetParam().type), rate,
              GetParam().rate);
  EXPECT_NEAR(rate, GetParam().rate, 0.3);
}

INSTANTIATE_TEST_SUITE_P(
    Types, Cantilever,
    testing::Values(Expected{ElementType::tet4, 2.0}, Expected{ElementType::hex8, 2.0},
                    Expected{ElementType::wedge6, 2.0}, Expected{ElementType::pyramid5, 2.0},
                    Expected{ElementType::tet10, 4.0}, Expected{ElementType::hex20, 4.0},
                    Expected{ElementType::wedge15, 4.0}, Expected{ElementType::pyramid13, 4.0}),
    [](const auto& type) { return std::string(mesh::name(type.param.type)); });

double free_bending_frequency(const mesh::Mesh& mesh) {
  fem::Structure beam(mesh, material, {});
  return beam.solve_modes({.n_modes = 7}).frequency[6];  // about its thinner side
}

struct Bending {
  const char* name;
  int order;
  double rate_tolerance;
  std::function<mesh::Mesh(const test::BoxGrid&)> mesh;
};

/// Frequencies on three sizes, each half the one before,
/// the rate of their differences and where they head for.
struct Convergence {
  std::array<double, 3> frequency;
  double rate;
  double limit;
};

Convergence converge(const Bending& bending) {
  const std::array<int, 3> sizes = bending.order == 1 ? std::array{2, 4, 8} : std::array{1, 2, 4};
  Convergence result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int n = sizes[i];
    result.frequency[i] = free_bending_frequency(
        bending.mesh({.size = {0.24, 0.06, 0.05}, .cells = {6 * n, n, n}, .map = {}}));
  }
  const double last = result.frequency[1] - result.frequency[2];
  result.rate = std::log2((result.frequency[0] - result.frequency[1]) / last);
  result.limit = result.frequency[2] - last / (bending.order == 1 ? 3.0 : 15.0);
  return result;
}

Bending of_type(ElementType type) {
  return {mesh::name(type), is_quadratic(type) ? 2 : 1, 0.3,
          [type](const test::BoxGrid& grid) { return test::box_mesh(type, grid); }};
}

/// Refined, the solids stand elsewhere: the rate is that of like meshes only about.
Bending mixed(const char* name, int order) {
  return {name, order, 0.5,
          [order](const test::BoxGrid& grid) { return test::mixed_box_mesh(order, grid); }};
}

class FreeBeam : public testing::TestWithParam<Bending> {};

TEST_P(FreeBeam, BendsWithTheRateOfItsElementsToTheSameFrequency) {
  static const double expected = converge(of_type(ElementType::hex20)).limit;
  const auto [frequency, rate, limit] = converge(GetParam());
  std::printf("free bending, %-15s %.3f %.3f %.3f, rate %.2f, limit %.3f, of hex20 %.3f\n",
              GetParam().name, frequency[0], frequency[1], frequency[2], rate, limit, expected);
  EXPECT_NEAR(rate, 2.0 * GetParam().order, GetParam().rate_tolerance);
  // Extrapolation leaves what the rate is off: a tenth of the last error.
  EXPECT_NEAR(limit, expected, 0.1 * (frequency[2] - expected));
}

INSTANTIATE_TEST_SUITE_P(Types, FreeBeam,
                         testing::Values(of_type(ElementType::wedge6),
                                         of_type(ElementType::pyramid5), mixed("mixed_linear", 1),
                                         of_type(ElementType::wedge15),
                                         of_type(ElementType::pyramid13),
                                         mixed("mixed_quadratic", 2)),
                         [](const auto& type) { return std::string(type.param.name); });

// det of the free end's (V, M) over the clamped end's, state (w, ψ, V, M):
// w' = ψ + V/(κGA), ψ' = M/(EI), V' = −ρAω²w, M' = −V − ρIω²ψ.
double free_end(double omega, double length, double width, double thickness) {
  const double area = width * thickness;
  const double inertia = area * thickness * thickness / 12.0;
  const double shear = 5.0 / 6.0 * 0.5 * material.youngs_modulus * area;
  const double square = omega * omega * material.density;
  Eigen::Matrix4d slope = Eigen::Matrix4d::Zero();
  slope(0, 1) = 1.0;
  slope(0, 2) = 1.0 / shear;
  slope(1, 3) = 1.0 / (material.youngs_modulus * inertia);
  slope(2, 0) = -square * area;
  slope(3, 1) = -square * inertia;
  slope(3, 2) = -1.0;
  // Forces in units of EI/L², EI/L, lengths in L: the exponential then has entries of order one.
  const double unit = material.youngs_modulus * inertia / (length * length);
  const Eigen::DiagonalMatrix<double, 4> scale(length, 1.0, unit, unit * length);
  const Eigen::Matrix4d scaled = length * (scale.inverse() * slope * scale);
  const Eigen::Matrix4d transfer = scaled.exp();
  return transfer.bottomRightCorner<2, 2>().determinant();
}

double timoshenko_frequency(double length, double width, double thickness) {
  const double euler = 3.5160152685 / (length * length) * thickness *
                       std::sqrt(material.youngs_modulus / (12.0 * material.density));
  double low = 0.9 * euler;
  double high = euler;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (std::signbit(free_end(middle, length, width, thickness)) ==
             std::signbit(free_end(low, length, width, thickness))
         ? low
         : high) = middle;
  }
  return 0.5 * (low + high);
}

TEST(Cantilever, BendsLikeTimoshenkosBeamFromAbove) {
  const double expected = timoshenko_frequency(0.2, 0.012, 0.01);
  double coarser = 1e300;
  double computed = 0.0;
  for (const int n : {1, 2, 4}) {
    const mesh::Mesh mesh = test::box_mesh(
        ElementType::tet10, {.size = {0.2, 0.012, 0.01}, .cells = {10 * n, n, n}, .map = {}});
    fem::Structure beam(mesh, material, {"x0"});
    computed = beam.solve_modes({.n_modes = 2}).frequency[0];
    std::printf("bending, tet10 n = %d: computed %.6f, Timoshenko %.6f, difference %.1e\n", n,
                computed, expected, computed / expected - 1.0);
    EXPECT_LT(computed, coarser);
    coarser = computed;
  }
  EXPECT_NEAR(computed, expected, 1e-4 * expected);
}

}  // namespace
}  // namespace microslip::cantilever
