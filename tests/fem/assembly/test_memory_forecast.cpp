// The forecast of a factorisation against what MUMPS asks for once it has the matrix.
#include "fem/memory_forecast.hpp"

#include <cstdio>

#include <gtest/gtest.h>
#include <slepceps.h>

#include "fem/assembly/fe_system.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "tests/support/box_mesh.hpp"

namespace microslip::fem::test_memory_forecast {
namespace {

using mesh::ElementType;

const Material steel{2.0e11, 0.3, 7800.0};

struct Asked {
  double nonzeros = 0.0;
  double megabytes = 0.0;
};

/// By the analysis of MUMPS alone; nothing is factorised.
Asked asked_by_mumps(const mesh::Mesh& mesh) {
  const FeSystem system = assemble(mesh, steel, {"x0"});
  MatHandle factor;
  MatFactorInfo options;
  PetscInt numbers = 0;
  PetscInt megabytes = 0;
  check(MatSetOption(system.stiffness.get(), MAT_SPD, PETSC_TRUE));
  check(MatGetFactor(system.stiffness.get(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.out()));
  check(MatFactorInfoInitialize(&options));
  check(MatCholeskyFactorSymbolic(factor.get(), system.stiffness.get(), nullptr, &options));
  check(MatMumpsGetInfog(factor.get(), 20, &numbers));  // below 0: millions
  check(MatMumpsGetInfog(factor.get(), 17, &megabytes));
  return {numbers < 0 ? -1e6 * numbers : numbers, static_cast<double>(megabytes)};
}

struct Shape {
  const char* name;
  ElementType type;
  Eigen::Vector3d size;
  std::array<int, 3> cells;
};

class Bodies : public testing::TestWithParam<Shape> {};

// Compact, slender, flat: a power of the unknowns would err by three between them.
TEST_P(Bodies, TakeWhatTheForecastSays) {
  const Shape& shape = GetParam();
  const mesh::Mesh mesh =
      test::box_mesh(shape.type, {.size = shape.size, .cells = shape.cells, .map = {}});
  const Asked asked = asked_by_mumps(mesh);
  const double nonzeros = factor_size(mesh);
  const MemoryForecast forecast = direct_memory(mesh);
  std::printf("%s: %ld unknowns, nonzeros %.3g (MUMPS %.3g), %.0f MB (MUMPS %.0f)\n", shape.name,
              static_cast<long>(3 * mesh.n_nodes()), nonzeros, asked.nonzeros, forecast.solver,
              asked.megabytes);
  // Planes against the ordering of MUMPS; measured 0.69 to 1.26 with 25 000 to 390 000 unknowns.
  EXPECT_GT(asked.nonzeros, 0.65 * nonzeros);
  EXPECT_LT(asked.nonzeros, 1.35 * nonzeros);
  EXPECT_GT(asked.megabytes, 0.7 * forecast.solver);
  EXPECT_LT(asked.megabytes, 1.3 * forecast.solver);
}

INSTANTIATE_TEST_SUITE_P(
    All, Bodies,
    testing::Values(Shape{"cube", ElementType::tet10, {1, 1, 1}, {12, 12, 12}},
                    Shape{"cube of hexahedra", ElementType::hex20, {1, 1, 1}, {12, 12, 12}},
                    Shape{"beam", ElementType::tet10, {10, 1, 1}, {50, 5, 5}},
                    Shape{"plate", ElementType::tet10, {10, 10, 1}, {24, 24, 2}}));

TEST(FactorSize, OfOneElementIsItsTriangle) {
  const mesh::Mesh mesh =
      test::box_mesh(ElementType::hex8, {.size = {1, 1, 1}, .cells = {1, 1, 1}, .map = {}});
  EXPECT_EQ(factor_size(mesh), 9.0 * 8 * 9 / 2);  // equation (1) with s = 8, b = 0
}

TEST(FactorSize, OfAChainGrowsWithItsLength) {
  const auto chain = [](int n) {
    return factor_size(test::box_mesh(ElementType::hex8,
                                      {.size = {1.0 * n, 1, 1}, .cells = {n, 1, 1}, .map = {}}));
  };
  EXPECT_NEAR(chain(2048) / chain(1024), 2.0, 0.01);
}

// The outer nodes, of which a coarse mesh has more, have fewer neighbours.
constexpr double boundary = 0.1;

mesh::Mesh cube(ElementType type, int n) {
  return test::box_mesh(type, {.size = {1, 1, 1}, .cells = {n, n, n}, .map = {}});
}

double growth(double unknowns, double coarse, double fine) { return fine / coarse / unknowns; }

TEST(MemoryForecast, OfTheIterativeWayGrowsWithTheUnknownsAloneWhereThereAreCornersOnly) {
  const mesh::Mesh coarse = cube(ElementType::hex8, 10);
  const mesh::Mesh fine = cube(ElementType::hex8, 20);
  const double unknowns = double(fine.n_nodes()) / double(coarse.n_nodes());
  EXPECT_NEAR(growth(unknowns, iterative_memory(coarse).total(), iterative_memory(fine).total()),
              1.0, boundary);
  EXPECT_GT(growth(unknowns, direct_memory(coarse).total(), direct_memory(fine).total()), 1.25);
}

TEST(MemoryForecast, OfTheIterativeWayHasTheFactorOfTheCornersBesideWhatGrowsWithTheUnknowns) {
  const mesh::Mesh coarse = cube(ElementType::tet10, 6);
  const mesh::Mesh fine = cube(ElementType::tet10, 12);
  const double unknowns = double(fine.n_nodes()) / double(coarse.n_nodes());
  const auto rest = [](const mesh::Mesh& mesh, int n) {
    const double corners = direct_memory(cube(ElementType::tet4, n)).solver;
    EXPECT_GT(corners, 0.0);
    return iterative_memory(mesh).total() - corners;
  };
  EXPECT_NEAR(growth(unknowns, rest(coarse, 6), rest(fine, 12)), 1.0, boundary);
  EXPECT_GT(growth(unknowns, direct_memory(coarse).total(), direct_memory(fine).total()), 1.5);
}

}  // namespace
}  // namespace microslip::fem::test_memory_forecast
