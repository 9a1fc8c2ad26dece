#include "solver/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace microslip::solver {
namespace {

// Eigenvalues of a matrix whose entries are of the size of ω carry errors of some 1e-13 ω; a growth
// below this share of ω takes over 1e9 periods to show.
constexpr double growth_tolerance = 1e-10;
// Slow flow holds for what is slow against the cycle. Modes far from resonance turn at |ω_n ± ω| in it,
// and the mean at ω_n: a hysteretic force answers those by another law, so they are not judged.
constexpr double slow_share = 0.25;  // of ω

double sign_of_determinant(const Eigen::MatrixXd& matrix) {
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix);
  auto sign = static_cast<double>(factors.permutationP().determinant());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const double pivot = factors.matrixLU()(i, i);
    sign *= pivot > 0.0 ? 1.0 : (pivot < 0.0 ? -1.0 : 0.0);
  }
  return sign;
}

/// States (B, A^(1), …, A^(H), Ḃ): −M⁻¹ ∂R/∂x for the harmonics, second order for the mean.
Eigen::MatrixXd slow_flow(const HarmonicBalance& balance, const Eigen::MatrixXd& jacobian,
                          double frequency) {
  const Scene& scene = balance.scene();
  const Eigen::Index n = scene.n_modes();
  const Eigen::Index size = balance.size();
  const Eigen::ArrayXd damping =
      2.0 * scene.damping_ratio.array() * scene.natural_frequency.array();
  Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(size + n, size + n);
  flow.block(0, size, n, n).setIdentity();
  flow.block(size, 0, n, size) = -jacobian.topRows(n);
  flow.block(size, size, n, n).diagonal() = -damping.matrix();
  Eigen::Index s = n;
  for (const int k : balance.set().orders()) {
    const Eigen::Index c = s + n;
    const double spin = 2.0 * k * frequency;
    for (Eigen::Index i = 0; i < n; ++i) {
      // [c −2kω; 2kω c]⁻¹ = [c 2kω; −2kω c] / (c² + 4k²ω²)
      const double square = damping[i] * damping[i] + spin * spin;
      const auto sine = jacobian.row(s + i);
      const auto cosine = jacobian.row(c + i);
      flow.row(s + i).head(size) = -(damping[i] * sine + spin * cosine) / square;
      flow.row(c + i).head(size) = (spin * sine - damping[i] * cosine) / square;
    }
    s += 2 * n;
  }
  return flow;
}

/// A resonance near by is a pair −d ± i(ω_r − ω), or, close to it, two real values of which one vanishes
/// at a fold: there the other one tells the width.
double nearest_resonance(const Eigen::VectorXcd& eigenvalues) {
  double oscillating = std::numeric_limits<double>::infinity();
  double real = 0.0;
  for (const auto& value : eigenvalues) {
    if (value.imag() == 0.0) {
      real = std::max(real, std::abs(value.real()));
    } else {
      oscillating = std::min(oscillating, std::abs(value));
    }
  }
  return real > 0.0 ? std::min(real, oscillating) : oscillating;
}

}  // namespace

StabilityReport assess_stability(const HarmonicBalance& balance, const Eigen::MatrixXd& jacobian,
                                 double frequency) {
  StabilityReport report;
  report.determinant_sign = sign_of_determinant(jacobian);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(slow_flow(balance, jacobian, frequency), false);
  if (solver.info() != Eigen::Success) return report;
  report.nearest = nearest_resonance(solver.eigenvalues());
  report.growth = -std::numeric_limits<double>::infinity();
  for (const auto& value : solver.eigenvalues()) {
    if (std::abs(value.imag()) < slow_share * frequency) {
      report.growth = std::max(report.growth, value.real());
    }
  }
  const bool grows = report.growth > growth_tolerance * frequency;
  report.stability =
      grows || report.determinant_sign < 0.0 ? Stability::unstable : Stability::stable;
  return report;
}

}  // namespace microslip::solver
