#include "solver/curve/linear_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <limits>
#include <vector>

#include "contact/dense.hpp"
#include "solver/curve/modal_enclosure.hpp"

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

Eigen::MatrixXd stiffness_of(const HarmonicBalance& balance, LinearState limit) {
  Eigen::MatrixXd K = balance.scene().natural_frequency.array().square().matrix().asDiagonal();
  if (limit == LinearState::stuck) K += balance.stuck_stiffness();
  return K;
}

/// Sine + i cosine.
Eigen::VectorXcd first_harmonic(const Harmonics& q) {
  return q.sine().transpose() + std::complex<double>(0.0, 1.0) * q.cosine().transpose();
}

/// Relative errors of an inverse and its products, as bounded by the backward error of elimination.
double backward_errors(Eigen::Index n) {
  return 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
}

class Proof {
 public:
  Proof(const HarmonicBalance& balance, LinearState limit)
      : balance_(balance),
        limit_(limit),
        n_(balance.scene().n_modes()),
        K_(stiffness_of(balance, limit)),
        damping_(2.0 *
                 balance.scene().damping_ratio.cwiseProduct(balance.scene().natural_frequency)),
        mean_(Eigen::VectorXd::Zero(n_)),
        load_(first_harmonic(balance.harmonics(balance.excitation()))),
        modal_(K_, damping_, load_) {
    const Harmonics Q = balance.harmonics(balance.excitation());
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
    if (holds_by_modes({low, high})) {
      ++n_intervals;
      return true;
    }
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
    return holds_by_modes(interval) || is_limit(enclose(interval));
  }

  [[nodiscard]] bool holds_by_modes(const Interval& interval) const {
    const ModalBox box = modal_.over(interval.low, interval.high);
    if (!std::isfinite(box.radius)) return false;
    return is_limit(
        {motion_of(box.centre), box.radius + mean_error_, modal_.modes() * box.reach.asDiagonal()});
  }

  [[nodiscard]] bool is_limit(const contact::MotionSet& motions) const {
    return std::isfinite(motions.radius) && motions.centre.rows().allFinite() &&
           balance_.scene().contact->linear_state_of(motions) == limit_;
  }

  /// About the static response.
  [[nodiscard]] Harmonics motion_of(const Eigen::VectorXcd& A) const {
    Harmonics motion(1, n_);
    motion.rows().row(0) = mean_.transpose();
    motion.rows().row(1) = A.real().transpose();
    motion.rows().row(2) = A.imag().transpose();
    return motion;
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

  [[nodiscard]] contact::MotionSet enclose(const Interval& interval) const {
    const contact::MotionSet nothing{Harmonics(1, n_), std::numeric_limits<double>::infinity()};
    const double omega = 0.5 * (interval.low + interval.high);
    const double h = std::max(interval.high - omega, omega - interval.low);
    // The norm of G diag(e) is no less: no inverse is needed to see it.
    if (!(h * (2.0 * omega + h) < contraction * modal_.distance(omega))) return nothing;
    Eigen::MatrixXcd D = K_.cast<std::complex<double>>();
    D.diagonal().array() += std::complex<double>(-omega * omega, 0.0);
    D.diagonal() += std::complex<double>(0.0, omega) * damping_.cast<std::complex<double>>();
    const auto inverse = contact::inverted(D);
    if (!inverse) return nothing;  // an undamped resonance
    const Eigen::VectorXcd A = *inverse * load_;
    const Eigen::MatrixXd G = inverse->cwiseAbs();
    const Eigen::VectorXd size = A.cwiseAbs();
    // λ − ω² cancels at a resonance: rounding is measured by its terms.
    Eigen::MatrixXd terms = backward_errors(n_) * K_.cwiseAbs();
    terms.diagonal().array() += backward_errors(n_) * (omega * omega + omega * damping_.array());
    const Eigen::VectorXd e = (h * (2.0 * omega + h + damping_.array().abs())).matrix();
    const Eigen::MatrixXd M = G * (Eigen::MatrixXd(e.asDiagonal()) + terms);
    contact::MotionSet result{motion_of(A), std::numeric_limits<double>::infinity()};
    if (!(M.rowwise().sum().maxCoeff() < contraction)) return result;  // NaN as well
    const Eigen::VectorXd first = M * size + backward_errors(n_) * (G * load_.cwiseAbs());
    // Room for the roundings of these bounds, which (3) then has to have in the numbers as they
    // are.
    constexpr double outwards = 1.0 + 1e-10;
    Eigen::VectorXd t =
        outwards * outwards *
        contact::solved(Eigen::MatrixXd::Identity(n_, n_) - M, Eigen::MatrixXd(first));
    t.array() += 1e-12 * t.maxCoeff();
    if (!((outwards * (first + M * t)).array() <= t.array()).all()) return result;
    result.radius = outwards * (t.norm() + mean_error_);
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
  ModalEnclosure modal_;
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
