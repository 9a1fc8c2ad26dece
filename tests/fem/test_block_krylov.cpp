#include "fem/block_krylov.hpp"

#include <gtest/gtest.h>

#include "fem/columns.hpp"
#include "fem/mode_search.hpp"
#include "fem/rigid_modes.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"

namespace microslip::fem {
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

TEST(BlockKrylov, FindsTheLowestPairsOfTheFullMatrices) {
  const Held bar;
  for (const Eigen::Index n : {1, 2, 5, 12, 40}) {  // 40 need restarts
    const EigenPairs pairs =
        lowest_pairs_by_blocks(bar.system, bar.inverse, 0.0, n, bar.nothing_known);
    ASSERT_GT(pairs.values.size(), n);
    EXPECT_LT(largest_error(pairs.values.head(n), bar.exact.head(n)), rounding) << n;
  }
}

TEST(BlockKrylov, GivesMassOrthonormalVectors) {
  const Held bar;
  const EigenPairs pairs =
      lowest_pairs_by_blocks(bar.system, bar.inverse, 0.0, 20, bar.nothing_known);
  const Eigen::MatrixXd gram =
      inner_products(pairs.vectors, multiply(bar.system.mass_matrix.get(), pairs.vectors));
  // Two passes of Gram–Schmidt leave rounding only.
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(),
            1e-13);
}

TEST(BlockKrylov, ShowsOnePairBeyondTheWantedOnesWellEnoughToSeeTheGap) {
  const Held bar;
  const EigenPairs pairs =
      lowest_pairs_by_blocks(bar.system, bar.inverse, 0.0, 6, bar.nothing_known);
  EXPECT_NEAR(pairs.values[6], bar.exact[6],
              1e-6 * bar.exact[6]);  // vector good to 1e-4, λ to its square
}

TEST(BlockKrylov, SearchesBesideWhatIsKnown) {
  const Held bar;
  const EigenPairs low = lowest_pairs_by_blocks(bar.system, bar.inverse, 0.0, 4, bar.nothing_known);
  const EigenPairs next =
      lowest_pairs_by_blocks(bar.system, bar.inverse, 0.0, 3, low.vectors.leftCols(4));
  EXPECT_LT(largest_error(next.values.head(3), bar.exact.segment(4, 3)), rounding);
}

TEST(BlockKrylov, FindsAllPairsOfASmallSpace) {
  const mesh::Mesh mesh = test::box_mesh(mesh::ElementType::hex8,
                                         {.size = {1.0, 0.9, 0.8}, .cells = {1, 1, 1}, .map = {}});
  const FeSystem system = assemble(mesh, steel, {"x0"});
  const Factorisation inverse(system.stiffness.get(), FactorKind::positive_definite);
  const EigenPairs pairs = lowest_pairs_by_blocks(system, inverse, 0.0, 30,
                                                  Eigen::MatrixXd(system.dofs.n_local_dofs(), 0));
  const Eigen::VectorXd exact = test::dense_system(mesh, steel, {"x0"}).eigenvalues();
  ASSERT_EQ(pairs.values.size(), 12);
  EXPECT_LT(largest_error(pairs.values, exact), rounding);
}

TEST(BlockKrylov, AgreesWithKrylovSchurBesideRigidMotions) {
  const mesh::Mesh mesh = square_bar();
  const FeSystem system = assemble(mesh, steel, {});
  const Eigen::MatrixXd rigid = rigid_body_modes(mesh, system);
  const double shift = -0.1 * elastic_scale(mesh.nodes(), system, rigid.cols());
  const Factorisation inverse(shifted_stiffness(system, shift).get(),
                              FactorKind::positive_definite);
  const EigenPairs blocks = lowest_pairs_by_blocks(system, inverse, shift, 8, rigid);
  const EigenPairs single = lowest_pairs(system, inverse, shift, 8, rigid);
  EXPECT_LT(largest_error(blocks.values.head(8), single.values.head(8)), rounding);
}

}  // namespace
}  // namespace microslip::fem
