/// Every response of an interval, by elimination at that frequency, lies in the ball that is told.
#include "solver/curve/modal_enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace microslip::solver::test_modal_enclosure {
namespace {

struct Oscillators {
  Eigen::MatrixXd K;
  Eigen::VectorXd damping;
  Eigen::VectorXcd load;

  [[nodiscard]] Eigen::VectorXcd response(double omega) const {
    Eigen::MatrixXcd D = K.cast<std::complex<double>>();
    D.diagonal().array() -= omega * omega;
    D.diagonal() += std::complex<double>(0.0, omega) * damping.cast<std::complex<double>>();
    return D.partialPivLu().solve(load);
  }
  [[nodiscard]] ModalEnclosure enclosure() const { return {K, damping, load}; }
};

/// Frequencies 1 … n, the last as stiff as attachment shapes are; springs of full rank two couple
/// the modes, and with them their damping.
Oscillators oscillators(std::uint64_t seed, double damping_ratio, double coupling) {
  constexpr Eigen::Index n = 7;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> g(0.0, 1.0);
  Eigen::VectorXd omega = Eigen::VectorXd::LinSpaced(n, 1.0, n);
  omega[n - 1] = 500.0;
  const Eigen::MatrixXd springs =
      std::sqrt(coupling) * Eigen::MatrixXd::NullaryExpr(n, 2, [&] { return g(random); });
  Oscillators all;
  all.K = springs * springs.transpose();
  all.K.diagonal() += omega.cwiseAbs2();
  all.damping = 2.0 * damping_ratio * omega;
  all.load =
      Eigen::VectorXcd::NullaryExpr(n, [&] { return std::complex<double>(g(random), g(random)); });
  return all;
}

/// Largest |z_j| over what it may be, of responses of the interval.
double reach(const Oscillators& all, const ModalEnclosure& enclosure, double low, double high) {
  const ModalBox box = enclosure.over(low, high);
  double largest = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const Eigen::VectorXcd z =
        enclosure.modes().transpose() * (all.response(low + (high - low) * i / 200.0) - box.centre);
    largest =
        std::max(largest, (z.cwiseAbs().array() / (box.reach.array() + box.radius)).maxCoeff());
  }
  return largest;
}

TEST(ModalEnclosure, HasEveryResponseOfTheInterval) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    for (const double damping_ratio : {1e-4, 2e-3, 0.05}) {
      const Oscillators all = oscillators(seed, damping_ratio, 0.5);
      const ModalEnclosure enclosure = all.enclosure();
      for (const double width : {0.0, 1e-4, 0.01, 0.3, 3.0}) {
        for (const double low : {0.7, 1.3, 2.0, 2.9}) {
          if (std::isinf(enclosure.over(low, low + width).radius)) continue;
          EXPECT_LE(reach(all, enclosure, low, low + width), 1.0)
              << seed << ' ' << damping_ratio << " from " << low << " by " << width;
        }
      }
    }
  }
}

// Between resonances it is as small as the response changes, and over a whole range some times as
// large as the highest peak.
TEST(ModalEnclosure, IsNotMuchLargerThanItMustBe) {
  int n_found = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Oscillators all = oscillators(seed, 2e-3, 0.5);
    const ModalEnclosure enclosure = all.enclosure();
    const double between = 1.4;
    if (enclosure.distance(between) > 0.1) {
      const ModalBox narrow = enclosure.over(between, between + 1e-3);
      EXPECT_LT(narrow.reach.norm(), 0.05 * all.response(between).norm()) << seed;
    }
    const ModalBox wide = enclosure.over(0.5, 3.0);
    if (std::isinf(wide.radius)) continue;
    ++n_found;
    double highest = 0.0;
    for (double omega = 0.5; omega < 3.0; omega *= 1.0003) {
      highest = std::max(highest, all.response(omega).norm());
    }
    EXPECT_LT(wide.reach.norm(), 4.0 * highest) << seed;
  }
  EXPECT_GT(n_found, 35);
}

// One oscillator: A = Q/(ω₀² − ω² + iωc), with a circle of its own about the resonance.
TEST(ModalEnclosure, OfOneResonanceIsHalfItsPeak) {
  Oscillators one{Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Constant(1, 0.01),
                  Eigen::VectorXcd::Constant(1, 3.0)};
  const double low = 0.99;
  const ModalBox box = one.enclosure().over(low, 1.02);
  EXPECT_NEAR(box.reach[0], 0.5 * 3.0 / (0.01 * low), 1e-6 * box.reach[0]);
  EXPECT_LE(reach(one, one.enclosure(), low, 1.02), 1.0);
}

TEST(ModalEnclosure, OfAnUndampedResonanceInTheIntervalIsNone) {
  Oscillators all = oscillators(1, 0.0, 0.0);
  EXPECT_TRUE(std::isinf(all.enclosure().over(0.9, 1.1).radius));
  EXPECT_TRUE(std::isfinite(all.enclosure().over(1.1, 1.2).radius));
}

}  // namespace
}  // namespace microslip::solver::test_modal_enclosure
