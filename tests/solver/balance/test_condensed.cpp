#include "solver/balance/condensed.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace microslip::solver::test_condensed {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index n_modes = 6;
constexpr Index n_few = 3;

MatrixXd numbers(Index rows, Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  return MatrixXd::NullaryExpr(rows, columns, [&] {
    return static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 0.5;
  });
}

/// Away from every resonance, at one without damping, at two of one harmonic row; with the mean and
/// without.
struct Case {
  double frequency, damping_ratio, contact;
  bool has_mean;
};
const std::vector<Case> cases{{0.6, 1e-2, 4.0, true},   {3.0, 0.0, 4.0, true},
                              {1.0, 1e-3, 400.0, true}, {7.0, 0.1, 0.0, true},
                              {0.6, 1e-2, 4.0, false},  {3.0, 0.0, 4.0, false},
                              {1.0, 1e-3, 400.0, false}};

/// Modes from 1 to 11 rad/s at harmonics of `frequency`, with a contact that has no symmetry.
BalanceEvaluation evaluation(const Case& one, unsigned seed) {
  CondensedJacobian parts;
  const Index first_sine = one.has_mean ? 1 : 0;
  const Index n_blocks = first_sine + 6;  // three harmonics
  const Index size = n_modes * n_blocks;
  parts.own = {n_modes, first_sine * n_modes, VectorXd(size), VectorXd::Zero(size)};
  for (Index block = 0; block < n_blocks; ++block) {
    const double turn = static_cast<double>((block - first_sine + 2) / 2) * one.frequency *
                        (block < first_sine ? 0.0 : 1.0);
    const bool is_sine = (block - first_sine) % 2 == 0;
    for (Index mode = 0; mode < n_modes; ++mode) {
      const double natural = 1.0 + 2.0 * static_cast<double>(mode);
      const Index i = block * n_modes + mode;
      const double dynamic = natural * natural - turn * turn;
      const double viscous = 2.0 * one.damping_ratio * natural * turn;
      parts.own.diagonal[i] = dynamic;
      parts.own.coupling[i] = is_sine ? -viscous : viscous;
      if (std::hypot(dynamic, viscous) < 0.1 * (natural * natural + turn * turn)) {
        parts.resonant.push_back(i);
      }
    }
  }
  parts.contact = std::make_shared<const contact::FewerDerivatives>(contact::FewerDerivatives{
      numbers(n_few, n_modes, seed),
      one.contact * numbers(n_few * n_blocks, n_few * n_blocks, 100 + seed)});
  BalanceEvaluation at;
  at.jacobian = BalanceJacobian(std::move(parts));
  at.parameter_derivative = numbers(size, 1, 200 + seed);
  at.residual = VectorXd::Zero(size);
  return at;
}

TEST(BorderedFactors, FewUnknownsSolveWhatAllDo) {
  const Scaling scaling{.x = 2e-3, .parameter = 3.0, .residual = 0.4};
  for (const Case& one : cases) {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
      const BalanceEvaluation at = evaluation(one, seed);
      ASSERT_NE(at.jacobian.parts(), nullptr);
      const Index size = at.residual.size();
      const BranchVector row{numbers(size, 1, 3), 0.7};
      const MatrixXd right = numbers(size + 1, 3, 9);
      const MatrixXd whole = bordered(at, row, scaling);
      const BorderedFactors factors(at, row, scaling);
      const MatrixXd expected = whole.lu().solve(right);
      const MatrixXd turned = whole.transpose().lu().solve(right);
      EXPECT_LT((factors.solve(right) - expected).norm(), 1e-9 * expected.norm()) << one.frequency;
      EXPECT_LT((factors.solve_transposed(right) - turned).norm(), 1e-9 * turned.norm());
      EXPECT_EQ(factors.sign_of_determinant(), whole.determinant() > 0.0 ? 1.0 : -1.0);
      EXPECT_EQ(sign_of_determinant(at.jacobian),
                at.jacobian.dense().determinant() > 0.0 ? 1.0 : -1.0);
      const VectorXd b = right.col(0).head(size);
      const VectorXd alone = at.jacobian.dense().lu().solve(b);
      EXPECT_LT((solved(at.jacobian, b) - alone).norm(), 1e-9 * alone.norm());
    }
  }
}

TEST(BorderedFactors, AtAResonanceWithoutDampingNothingIsDividedBy) {
  const BalanceEvaluation at = evaluation(cases[1], 1);
  const PairedDiagonal& own = at.jacobian.parts()->own;
  EXPECT_EQ((own.diagonal.array() == 0.0 && own.coupling.array() == 0.0).count(), 4);
}

TEST(NullVector, OfFewUnknownsIsThatOfAll) {
  const Scaling scaling{.x = 2e-3, .parameter = 3.0, .residual = 0.4};
  for (const Case& one : cases) {
    const BalanceEvaluation at = evaluation(one, 6);
    BalanceEvaluation whole = at;
    whole.jacobian = at.jacobian.dense();
    for (const double orientation : {1.0, -1.0}) {
      const auto found = null_vector(at, scaling, orientation);
      const auto expected = null_vector(whole, scaling, orientation);
      ASSERT_TRUE(found && expected);
      EXPECT_LT((found->x - expected->x).norm(), 1e-9);
      EXPECT_NEAR(found->parameter, expected->parameter, 1e-9);
    }
  }
}

TEST(SchurComplement, IsThatOfTheWholeMatrix) {
  const std::vector<Index> with_mean{6, 8, 12, 14, 18, 24};  // pairs of sine and cosine
  for (const Case& one : cases) {
    const BalanceEvaluation at = evaluation(one, 5);
    const Index shift = one.has_mean ? 0 : -n_modes;
    std::vector<Index> low = with_mean;
    for (Index& unknown : low) unknown += shift;
    const MatrixXd expected = schur_complement(at.jacobian.dense(), low);
    const MatrixXd condensed = schur_complement(at.jacobian, low);
    EXPECT_LT((condensed - expected).norm(), 1e-9 * expected.norm()) << one.frequency;
    // The inverse of a part of the inverse.
    const MatrixXd inverse = at.jacobian.dense().inverse();
    EXPECT_LT((condensed * inverse(low, low) - MatrixXd::Identity(6, 6)).norm(), 1e-7);
  }
}

}  // namespace
}  // namespace microslip::solver::test_condensed
