#include "solver/curve/linear_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <limits>
#include <vector>

#include "contact/dense.hpp"

namespace microslip::solver {
namespace {

using contact::LinearState;

// A curve is some hundred points; a proof that costs more than it saves is none worth having.
constexpr int most_intervals = 2000;
// Enclosures converge where the norm of G diag(e) is below 1; above this they are too wide to prove
// much.
constexpr double contraction = 0.5;

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

struct Enclosure {
  Harmonics centre;
  double radius = std::numeric_limits<double>::infinity();
};

/// Relative errors of an inverse and its products, as bounded by the backward error of elimination.
double backward_errors(Eigen::Index n) {
  return 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
}

class Proof {
 public:
  Proof(const HarmonicBalance& balance, LinearState limit)
      : balance_(balance), limit_(limit), n_(balance.scene().n_modes()) {
    const Scene& scene = balance.scene();
    K_ = scene.natural_frequency.array().square().matrix().asDiagonal();
    if (limit == LinearState::stuck) K_ += balance.stuck_stiffness();
    damping_ = 2.0 * scene.damping_ratio.array() * scene.natural_frequency.array();
    const Harmonics Q = balance.harmonics(balance.excitation());
    load_ = Q.sine().transpose() + std::complex<double>(0.0, 1.0) * Q.cosine().transpose();
    mean_ = Eigen::VectorXd::Zero(n_);
    if (Q.mean().norm() > 0.0) {
      const auto inverse = contact::inverted(K_);
      if (!inverse) {
        mean_error_ = std::numeric_limits<double>::infinity();
        return;
      }
      mean_ = *inverse * Q.mean().transpose();
      mean_error_ =
          backward_errors(n_) * (inverse->cwiseAbs() * (K_.cwiseAbs() * mean_.cwiseAbs())).norm();
    }
  }

  /// Proved over the whole range.
  bool run(double low, double high, int& n_intervals) {
    for (const double frequency : resonances(low, high)) {
      if (!holds({frequency, frequency}, n_intervals)) return false;
    }
    std::deque<Interval> open{{low, high}};
    while (!open.empty()) {
      const Interval next = open.front();
      open.pop_front();
      const double middle = 0.5 * (next.low + next.high);
      if (holds(next, n_intervals)) continue;
      const bool splits = next.low < middle && middle < next.high;
      // Breadth first: a frequency at which the conditions fail ends the attempt early.
      if (!splits || n_intervals > most_intervals || !holds({middle, middle}, n_intervals)) {
        return false;
      }
      open.push_back({next.low, middle});
      open.push_back({middle, next.high});
    }
    return true;
  }

 private:
  [[nodiscard]] bool holds(const Interval& interval, int& n_intervals) const {
    ++n_intervals;
    const Enclosure enclosure = enclose(interval);
    return std::isfinite(enclosure.radius) && enclosure.centre.rows().allFinite() &&
           balance_.scene().contact->linear_state(enclosure.centre, enclosure.radius) == limit_;
  }

  /// Frequencies at which amplitudes peak: there a limit that does not hold fails first.
  [[nodiscard]] std::vector<double> resonances(double low, double high) const {
    std::vector<double> list{low, high};
    const auto values = contact::symmetric_eigenvalues(K_);
    if (!values) return list;
    for (const double square : *values) {
      const double frequency = square > 0.0 ? std::sqrt(square) : 0.0;
      if (frequency > low && frequency < high) list.push_back(frequency);
    }
    return list;
  }

  [[nodiscard]] Enclosure enclose(const Interval& interval) const {
    const double omega = 0.5 * (interval.low + interval.high);
    const double h = std::max(interval.high - omega, omega - interval.low);
    Eigen::MatrixXcd D = K_.cast<std::complex<double>>();
    D.diagonal().array() += std::complex<double>(-omega * omega, 0.0);
    D.diagonal() += std::complex<double>(0.0, omega) * damping_.cast<std::complex<double>>();
    const auto inverse = contact::inverted(D);
    if (!inverse) return {};  // an undamped resonance
    const Eigen::VectorXcd A = *inverse * load_;
    const Eigen::MatrixXd G = inverse->cwiseAbs();
    const Eigen::VectorXd size = A.cwiseAbs();
    const Eigen::VectorXd error =
        backward_errors(n_) * (G * (D.cwiseAbs() * size + load_.cwiseAbs()));
    Enclosure result;
    result.centre = Harmonics(1, n_);
    result.centre.rows().row(0) = mean_.transpose();
    result.centre.rows().row(1) = A.real().transpose();
    result.centre.rows().row(2) = A.imag().transpose();
    if (h == 0.0) {
      result.radius = error.norm() + mean_error_;
      return result;
    }
    const Eigen::VectorXd e = (h * (2.0 * omega + h + damping_.array().abs())).matrix();
    const Eigen::MatrixXd M = G * e.asDiagonal();
    if (!(M.rowwise().sum().maxCoeff() < contraction)) return result;  // NaN as well
    const Eigen::VectorXd spread =
        contact::solved(Eigen::MatrixXd::Identity(n_, n_) - M, M * (size + error));
    result.radius = (1.0 + 1e-12) * ((spread + error).norm() +
                                     mean_error_);  // 1e-12: rounding of a sum of n² terms
    return result;
  }

  const HarmonicBalance& balance_;
  LinearState limit_;
  Eigen::Index n_;
  Eigen::MatrixXd K_;
  Eigen::VectorXd damping_;
  Eigen::VectorXd mean_;
  double mean_error_ = 0.0;
  Eigen::VectorXcd load_;
};

}  // namespace

LinearCertificate certify_linear(const HarmonicBalance& balance, double low, double high) {
  LinearCertificate certificate;
  if (!balance.scene().contact) return certificate;
  const Harmonics Q = balance.harmonics(balance.excitation());
  const Eigen::Index beyond = Q.rows().rows() - 3;
  if (Q.rows().bottomRows(beyond).norm() > 0.0) return certificate;
  for (const LinearState limit : {LinearState::stuck, LinearState::free}) {
    if (Proof(balance, limit).run(low, high, certificate.n_intervals)) {
      certificate.state = limit;
      break;
    }
  }
  return certificate;
}

}  // namespace microslip::solver
