#include "fem/eigen/eigensolver.hpp"

#include <gtest/gtest.h>

#include "fem/eigen/mode_search.hpp"
#include "fem/eigen/rigid_modes.hpp"
#include "fem/petsc/columns.hpp"
#include "fem/petsc/factorisation.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"

namespace microslip::fem::test_eigensolver {
namespace {

const Material steel{.youngs_modulus = 2.0e11, .poissons_ratio = 0.3, .density = 7800.0};

// A square section: bending comes in twins.
mesh::Mesh square_bar() {
  return test::box_mesh(mesh::ElementType::tet4,
                        {.size = {0.1, 0.02, 0.02}, .cells = {8, 2, 2}, .map = {}});
}

struct Held {
  mesh::Mesh mesh = square_bar();
  FeSystem system = assemble(mesh, steel, {"x0"});
  Factorisation inverse{system.stiffness.get(), FactorKind::positive_definite};
  Eigen::VectorXd exact = test::dense_system(mesh, steel, {"x0"}).eigenvalues();
  Eigen::MatrixXd nothing_known{system.dofs.n_local_dofs(), 0};
};

// λ errs by the square of the vector's error, 1e-9 at most; what is left is rounding, about
// 1e-16 λ_max/λ ≈ 1e-11 here.
constexpr double rounding = 1e-10;

double largest_error(const Eigen::VectorXd& values, const Eigen::VectorXd& exact) {
  return (values - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff();
}

TEST(Eigensolver, FindsTheLowestPairsOfTheFullMatrices) {
  const Held bar;
  for (const Eigen::Index n : {1, 2, 5, 12, 40}) {
    const FoundPairs found = lowest_pairs(bar.system, bar.inverse, 0.0, n, bar.nothing_known);
    ASSERT_GE(found.pairs.values.size(), n);
    EXPECT_LT(largest_error(found.pairs.values.head(n), bar.exact.head(n)), rounding) << n;
  }
}

TEST(Eigensolver, GivesMassOrthonormalVectors) {
  const Held bar;
  const EigenPairs pairs = lowest_pairs(bar.system, bar.inverse, 0.0, 20, bar.nothing_known).pairs;
  const Eigen::MatrixXd gram =
      inner_products(pairs.vectors, multiply(bar.system.mass_matrix.get(), pairs.vectors));
  // Full reorthogonalisation leaves rounding only.
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(),
            1e-13);
}

// The estimate is below by its own error, which is small for the first that has not converged.
TEST(Eigensolver, EstimatesWhatComesNextFromBelow) {
  const Held bar;
  for (const Eigen::Index n : {1, 3, 6, 12}) {
    const FoundPairs found = lowest_pairs(bar.system, bar.inverse, 0.0, n, bar.nothing_known);
    const Eigen::Index n_found = found.pairs.values.size();
    ASSERT_GT(found.beyond.size(), 0);
    EXPECT_LT(found.beyond[0], bar.exact[n_found] * (1.0 + rounding)) << n;
    EXPECT_GT(found.beyond[0], 0.9 * bar.exact[n_found]) << n;
  }
}

TEST(Eigensolver, SearchesBesideWhatIsKnown) {
  const Held bar;
  const EigenPairs low = lowest_pairs(bar.system, bar.inverse, 0.0, 4, bar.nothing_known).pairs;
  const EigenPairs next =
      lowest_pairs(bar.system, bar.inverse, 0.0, 3, low.vectors.leftCols(4)).pairs;
  EXPECT_LT(largest_error(next.values.head(3), bar.exact.segment(4, 3)), rounding);
}

TEST(Eigensolver, FindsAllPairsOfASmallSpace) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex8,
                                         {.size = {1.0, 0.9, 0.8}, .cells = {1, 1, 1}, .map = {}});
  const FeSystem system = assemble(mesh, steel, {"x0"});
  const Factorisation inverse(system.stiffness.get(), FactorKind::positive_definite);
  const FoundPairs found =
      lowest_pairs(system, inverse, 0.0, 30, Eigen::MatrixXd(system.dofs.n_local_dofs(), 0));
  const Eigen::VectorXd exact = test::dense_system(mesh, steel, {"x0"}).eigenvalues();
  ASSERT_EQ(found.pairs.values.size(), 12);
  EXPECT_EQ(found.beyond.size(), 0);
  EXPECT_LT(largest_error(found.pairs.values, exact), rounding);
}

// What the search leaves of high modes is seen by K; one step turns it down to rounding: 1e-16
// times λ_max/λ, 1e5 here.
TEST(Eigensolver, RefiningLeavesResidualsOfRounding) {
  const Held bar;
  const EigenPairs found = lowest_pairs(bar.system, bar.inverse, 0.0, 6, bar.nothing_known).pairs;
  const EigenPairs refined = refine(bar.system, bar.inverse, found.vectors);
  EXPECT_LT(relative_residuals(bar.system, found).maxCoeff(), 1e-5);
  EXPECT_LT(relative_residuals(bar.system, refined).head(6).maxCoeff(), 1e-10);
}

TEST(ModeSearch, FindsTheModesOfAFreeBarBesideItsRigidMotions) {
  const mesh::Mesh mesh = square_bar();
  const FeSystem system = assemble(mesh, steel, {});
  const Eigen::MatrixXd rigid = rigid_body_modes(mesh, system);
  const double shift = -0.1 * elastic_scale(mesh.nodes(), system, rigid.cols());
  const Factorisation inverse(shifted_stiffness(system, shift).get(),
                              FactorKind::positive_definite);
  const CountedPairs found = find_elastic_modes(system, inverse, shift, 8, rigid);
  const Eigen::VectorXd exact = test::dense_system(mesh, steel, {}).eigenvalues();
  EXPECT_LT(largest_error(found.pairs.values.head(8), exact.segment(6, 8)), rounding);
  EXPECT_EQ(found.n_counted, 6 + found.n_below);
}

// One Krylov vector sees one of two modes with one frequency; the count tells, and the other is
// found.
TEST(ModeSearch, FindsTheTwinThatTheFirstSearchMissed) {
  const mesh::Mesh mesh = test::box_mesh(
      mesh::ElementType::hex20, {.size = {0.1, 0.02, 0.02}, .cells = {4, 2, 2}, .map = {}});
  const FeSystem system = assemble(mesh, steel, {"x0"});
  const Factorisation inverse(system.stiffness.get(), FactorKind::positive_definite);
  const Eigen::MatrixXd none(system.dofs.n_local_dofs(), 0);
  const CountedPairs found = find_elastic_modes(system, inverse, 0.0, 1, none);
  EXPECT_EQ(found.n_counted, 2);
  EXPECT_EQ(found.n_below, 2);
  EXPECT_NEAR(found.pairs.values[0], found.pairs.values[1], rounding * found.pairs.values[1]);
}

}  // namespace
}  // namespace microslip::fem::test_eigensolver
