#include "contact/force/point_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace microslip::contact::test_point_projection {
namespace {

std::mt19937_64& generator() {
  static std::mt19937_64 random(1);
  return random;
}

Eigen::MatrixXd noise(Eigen::Index rows, Eigen::Index columns) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return u(generator()); });
}

// Sums of up to 60 products of three numbers of size one, in another order.
constexpr double rounding = 1e-13;

// Numbers of modes around the widths of the machine's vectors; blocks whole and broken; some rows
// only.
TEST(PointProjection, IsTheSumByItsDefinition) {
  for (const Eigen::Index n_modes : {1, 2, 3, 4, 7, 8, 10, 17}) {
    for (const std::size_t n_signals : {2U, 3U}) {
      for (const int H : {1, 3}) {
        const Eigen::Index n_points = 5 + 7 * n_modes % 40;
        const std::vector<Eigen::MatrixXd> phi{noise(n_points, n_modes), noise(n_points, n_modes),
                                               noise(n_points, n_modes)};
        std::vector<const Eigen::MatrixXd*> shapes;
        for (std::size_t s = 0; s < n_signals; ++s) shapes.push_back(&phi[s]);
        const Eigen::Index R = 2 * H + 1;
        const std::vector<Eigen::Index> rows =
            H == 1 ? std::vector<Eigen::Index>{0, 1, 2} : std::vector<Eigen::Index>{1, 2, 5};
        const auto n = static_cast<Eigen::Index>(rows.size());
        Eigen::MatrixXd force = Eigen::MatrixXd::Zero(R, n_modes);
        Eigen::MatrixXd by_frequency = Eigen::MatrixXd::Zero(R, n_modes);
        Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n * n_modes, n * n_modes);
        double defect = 0.0;
        PointProjection sum;
        sum.start(shapes, H, rows);
        for (Eigen::Index i = 0; i < n_points; ++i) {
          PointTraction t;
          t.force = Harmonics(H, n_point_signals);
          t.force.rows() = noise(R, n_point_signals);
          t.jacobian = noise(3 * R, 3 * R);
          t.frequency_derivative =
              i % 3 == 0 ? Eigen::VectorXd(noise(3 * R, 1)) : Eigen::VectorXd::Zero(3 * R);
          t.regime = i % 5 == 1 ? CycleRegime::separated : CycleRegime::stick_slip;
          t.defect = i == 2 ? 0.5 : 0.0;
          const double weight = 0.1 * static_cast<double>(i);
          const double at_rest = 0.3;
          sum.add(i, weight, at_rest, t);
          double shape = 0.0;
          for (std::size_t s = 0; s < n_signals; ++s) {
            const auto signal = static_cast<Eigen::Index>(s);
            shape += phi[s].row(i).squaredNorm();
            for (Eigen::Index k = 0; k < R; ++k) {
              const double load = s == 1 && k == 0 ? at_rest : 0.0;
              force.row(k) += weight * (t.force.rows()(k, signal) - load) * phi[s].row(i);
              by_frequency.row(k) +=
                  weight * t.frequency_derivative[3 * k + signal] * phi[s].row(i);
            }
            for (std::size_t r = 0; r < n_signals && t.regime != CycleRegime::separated; ++r) {
              for (Eigen::Index k = 0; k < n; ++k) {
                for (Eigen::Index l = 0; l < n; ++l) {
                  const double a = t.jacobian(
                      3 * rows[static_cast<std::size_t>(k)] + signal,
                      3 * rows[static_cast<std::size_t>(l)] + static_cast<Eigen::Index>(r));
                  jacobian.block(k * n_modes, l * n_modes, n_modes, n_modes) +=
                      weight * a * phi[s].row(i).transpose() * phi[r].row(i);
                }
              }
            }
          }
          defect += weight * t.defect * std::sqrt(shape);
        }
        const ForceAndJacobian result = sum.take();
        EXPECT_LE((result.force.rows() - force).cwiseAbs().maxCoeff(), rounding);
        EXPECT_LE((result.jacobian - jacobian).cwiseAbs().maxCoeff(), rounding);
        EXPECT_NEAR(result.defect, defect, rounding);
        for (Eigen::Index k = 0; k < n; ++k) {
          const Eigen::VectorXd expected =
              by_frequency.row(rows[static_cast<std::size_t>(k)]).transpose();
          EXPECT_LE((result.frequency_derivative.segment(k * n_modes, n_modes) - expected)
                        .cwiseAbs()
                        .maxCoeff(),
                    rounding);
        }
      }
    }
  }
}

TEST(PointProjection, ForgetsTheSumBefore) {
  const Eigen::MatrixXd phi = noise(20, 5);
  const std::vector<const Eigen::MatrixXd*> shapes{&phi, &phi};
  const std::vector<Eigen::Index> rows{0, 1, 2};
  PointTraction t;
  t.force = Harmonics(1, n_point_signals);
  t.force.rows() = noise(3, 3);
  t.jacobian = noise(9, 9);
  t.frequency_derivative = noise(9, 1);
  t.regime = CycleRegime::stick_slip;
  PointProjection sum;
  const auto add_up = [&] {
    sum.start(shapes, 1, rows);
    for (Eigen::Index i = 0; i < 20; ++i) sum.add(i, 1.0, 0.0, t);
    return sum.take();
  };
  const ForceAndJacobian first = add_up();
  sum.start(shapes, 1, {});
  sum.add(3, 2.0, 1.0, t);
  EXPECT_EQ(sum.take().jacobian.size(), 0);
  const ForceAndJacobian again = add_up();
  EXPECT_EQ(first.force.rows(), again.force.rows());
  EXPECT_EQ(first.jacobian, again.jacobian);
  EXPECT_EQ(first.frequency_derivative, again.frequency_derivative);
}

TEST(ProjectionKernels, AgreeWithThePlainOnes) {
  const std::vector<const ProjectionKernels*> kernels = runnable_projection_kernels();
  ProjectionSizes size{10, 2, 5, 16, 80, 8 * 80};
  const Eigen::MatrixXd phi = noise(16, 8);
  const Eigen::MatrixXd a = noise(100, 1);
  std::vector<Eigen::VectorXd> sum;
  for (const ProjectionKernels* kernel : kernels) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(5 * 8 * 80);
    for (Eigen::Index point = 0; point < 4; ++point) {
      kernel->spread(size, phi.col(2 * point).data(), a.data(), y.data() + 2 * point * 80);
    }
    Eigen::VectorXd c = Eigen::VectorXd::Zero(10 * 80);
    kernel->add(size, 8, phi.data(), y.data() + 3 * 8 * 80, c.data());
    // Beyond the columns there is nothing to compare.
    Eigen::VectorXd used(500);
    for (Eigen::Index m = 0; m < 10; ++m) used.segment(50 * m, 50) = c.segment(80 * m, 50);
    sum.push_back(used);
  }
  ASSERT_FALSE(sum.empty());
  EXPECT_GT(sum.front().norm(), 1.0);
  for (const Eigen::VectorXd& other : sum) {
    EXPECT_LE((other - sum.front()).cwiseAbs().maxCoeff(), rounding);
  }
}

}  // namespace
}  // namespace microslip::contact::test_point_projection
