/// A patch in lanes is summed in parts, by as many cores as there are to spare.
#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "contact/sampled/patch_force.hpp"
#include "contact/spare_cores.hpp"
#include "support/planar_cases.hpp"
#include "tests/support/asked_force.hpp"
#include "tests/support/floating_point_traps.hpp"

namespace microslip::contact::sampled::test_patch_parts {
namespace {

// Lanes compute what they then do not take.
[[maybe_unused]] const tests::UntrappedFile this_file(__FILE__);

constexpr double frequency = 40.0;
constexpr int n_modes = 3;

/// Points of many kinds with shapes of their own under one motion.
struct ManyPoints {
  Eigen::VectorXd weights;
  std::vector<SurfaceLaw> surfaces;
  ModalShapes shapes;
  Harmonics q;

  ManyPoints(Eigen::Index n, bool planar) : q(3, n_modes) {
    std::mt19937_64 random(20261124);
    std::uniform_real_distribution<double> some(-1.0, 1.0);
    const auto draw = [&](Eigen::Index rows, Eigen::Index cols) {
      return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return some(random); }).eval();
    };
    weights = draw(n, 1).cwiseAbs();
    for (Eigen::Index i = 0; i < n; ++i) {
      const PointParameters point{1.0 + some(random) / 2.0, 1.0 + some(random) / 2.0,
                                  0.4 + some(random) / 5.0, some(random)};
      surfaces.emplace_back(point, 1.0 + some(random) / 2.0);
    }
    shapes.u = draw(n, n_modes);
    shapes.v = draw(n, n_modes);
    if (planar) shapes.w = draw(n, n_modes);
    q.rows() = draw(q.rows().rows(), n_modes);
  }

  [[nodiscard]] ForceAndJacobian force(int n_cores) const {
    allow_cores(n_cores);
    PatchForce patch(weights, surfaces, shapes, 128);
    ForceAndJacobian result = tests::evaluate(patch, q, frequency);
    allow_cores(1);
    return result;
  }

  /// Of each point by itself.
  [[nodiscard]] ForceAndJacobian sum_of_points() const {
    ForceAndJacobian sum;
    for (Eigen::Index i = 0; i < weights.size(); ++i) {
      ModalShapes one{shapes.u.row(i), shapes.v.row(i), {}};
      if (shapes.w.size() > 0) one.w = shapes.w.row(i);
      PatchForce point(weights.segment(i, 1), {surfaces[static_cast<std::size_t>(i)]},
                       std::move(one), 128);
      ForceAndJacobian part = tests::evaluate(point, q, frequency);
      if (i == 0) {
        sum = std::move(part);
        continue;
      }
      sum.force.rows() += part.force.rows();
      sum.jacobian += part.jacobian;
      sum.defect += part.defect;
    }
    return sum;
  }
};

class PatchParts : public ::testing::TestWithParam<bool> {};

TEST_P(PatchParts, ThePatchIsTheSumOfItsPoints) {
  for (const Eigen::Index n : {1, 16, 63, 64, 65, 200, 777}) {
    const ManyPoints patch(n, GetParam());
    const ForceAndJacobian whole = patch.force(3);
    const ForceAndJacobian sum = patch.sum_of_points();
    EXPECT_LT((whole.force.rows() - sum.force.rows()).norm(), 1e-12 * sum.force.rows().norm()) << n;
    EXPECT_LT((whole.jacobian - sum.jacobian).norm(), 1e-12 * sum.jacobian.norm()) << n;
    EXPECT_NEAR(whole.defect, sum.defect, 1e-12 * sum.defect) << n;
  }
}

TEST_P(PatchParts, BitsDoNotDependOnTheNumberOfCores) {
  const ManyPoints patch(500, GetParam());
  const ForceAndJacobian alone = patch.force(1);
  for (int again = 0; again < 20; ++again) {
    for (const int n_cores : {2, 3, 16}) {
      const ForceAndJacobian shared = patch.force(n_cores);
      EXPECT_EQ(shared.force.rows(), alone.force.rows()) << n_cores;
      EXPECT_EQ(shared.jacobian, alone.jacobian) << n_cores;
      EXPECT_EQ(shared.defect, alone.defect) << n_cores;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, PatchParts, ::testing::Values(false, true),
                         [](const auto& test) { return test.param ? "Two" : "One"; });

}  // namespace
}  // namespace microslip::contact::sampled::test_patch_parts
