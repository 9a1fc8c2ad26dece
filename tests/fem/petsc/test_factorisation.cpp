#include "fem/petsc/factorisation.hpp"

#include <string>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "fem/assembly/fe_system.hpp"
#include "fem/eigen/mode_search.hpp"
#include "fem/petsc/petsc_check.hpp"
#include "fem/petsc_error.hpp"
#include "fem/ranks.hpp"
#include "tests/support/address_space.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/dense_system.hpp"

namespace microslip::fem::test_factorisation {
namespace {

const Material titanium{1.14e11, 0.32, 4430.0};

mesh::Mesh block() {
  return test::box_mesh(mesh::ElementType::tet10,
                        {.size = {0.1, 0.05, 0.04}, .cells = {3, 2, 2}, .map = {}});
}

TEST(Factorisation, SolvesManyRightHandSidesAtOnce) {
  const FeSystem system = assemble(block(), titanium, {"x0"});
  const Factorisation factor(system.stiffness.get(), FactorKind::positive_definite);
  const test::DenseSystem dense = test::dense_system(block(), titanium, {"x0"});
  const Eigen::MatrixXd loads = Eigen::MatrixXd::Random(3 * block().n_nodes(), 5);
  const Eigen::MatrixXd u = system.dofs.to_mesh(factor.solve(system.dofs.to_local(loads)));
  const Eigen::MatrixXd exact = dense.K.llt().solve(dense.reduce(loads));
  EXPECT_LT((dense.reduce(u) - exact).norm(),
            1e-10 * exact.norm());  // condition 1e5 times rounding
}

TEST(Factorisation, CountsTheEigenvaluesBelowEveryShift) {
  const FeSystem system = assemble(block(), titanium, {"x0"});
  const Eigen::VectorXd values = test::dense_system(block(), titanium, {"x0"}).eigenvalues();
  for (const Eigen::Index n : {0, 1, 7, 30, 200}) {
    const double shift = n == 0 ? 0.5 * values[0] : 0.5 * (values[n - 1] + values[n]);
    for (const FactorKind kind : {FactorKind::indefinite, FactorKind::inertia_only}) {
      const Factorisation factor(shifted_stiffness(system, shift).get(), kind);
      EXPECT_EQ(factor.inertia().negative, n);
      EXPECT_EQ(factor.inertia().zero, 0);
    }
  }
}

TEST(Factorisation, ThatDoesNotFitIsRefusedWithItsSize) {
  const FeSystem system = assemble(block(), titanium, {"x0"});
  try {
    const Factorisation factor(system.stiffness.get(), FactorKind::positive_definite, 0.5);
    FAIL() << "half a megabyte was enough";
  } catch (const MemoryError& error) {
    EXPECT_NE(std::string(error.what()).find("out of memory: the factorisation needs about"),
              std::string::npos)
        << error.what();
  }
}

/// K of a string of springs, held at its first end.
MatHandle springs(PetscInt n) {
  MatHandle matrix;
  check(MatCreateSeqAIJ(PETSC_COMM_SELF, n, n, 3, nullptr, matrix.out()));
  for (PetscInt i = 0; i < n; ++i) {
    check(MatSetValue(matrix.get(), i, i, i + 1 < n ? 2.0 : 1.0, INSERT_VALUES));
    if (i + 1 == n) break;
    check(MatSetValue(matrix.get(), i, i + 1, -1.0, INSERT_VALUES));
    check(MatSetValue(matrix.get(), i + 1, i, -1.0, INSERT_VALUES));
  }
  check(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
  return matrix;
}

// Met with a run under ulimit -v: MUMPS needs a third array of the size of loads and solution.
TEST(Factorisation, ASolutionThatDoesNotFitIsOutOfMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer takes terabytes of address space";
#endif
  if (n_ranks() > 1) GTEST_SKIP() << "the matrix is that of one rank";
  const Factorisation factor(springs(140'000).get(), FactorKind::positive_definite);
  const Eigen::MatrixXd loads = Eigen::MatrixXd::Ones(140'000, 32);
  std::string message = "it fitted";
  try {
    const test::Room room(2.5 * 8e-6 * static_cast<double>(loads.size()));
    static_cast<void>(factor.solve(loads));
  } catch (const MemoryError& error) {
    message = error.what();
  } catch (const std::exception& error) {
    message = std::string("told otherwise: ") + error.what();
  }
  EXPECT_EQ(message.rfind("out of memory: MUMPS failed in the solution", 0), 0U) << message;
}

}  // namespace
}  // namespace microslip::fem::test_factorisation
