#include "solver/harmonics/harmonic_screening.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <utility>

#include <Eigen/LU>

#include "solver/balance/output_amplitude.hpp"

namespace microslip::solver {
namespace {

// Points from one probe to the next at most: a step turns the branch by some 7°, so that over these it may
// have gone round a resonance by half and the way back from the harmonics is another.
constexpr int most_uses = 8;
// By which the estimate may grow wrong from point to point. On chains of one contact point, where a step
// changes most, it is too small by more than this at one point in ten, on patches at none.
constexpr double margin = 1.5;

// Of the error that needs no more harmonics: what harmonics not looked at may do, each taken three times what
// the estimate says.
constexpr double skipped_share = 0.04;
constexpr double skipped_margin = 3.0;

/// Contact stiffness on the first harmonic, averaged over its phase [1/s²].
Eigen::MatrixXd mean_stiffness(const HarmonicBalance& balance, const NewtonResult& at) {
  const Eigen::Index n = balance.scene().n_modes();
  const Eigen::MatrixXd& jacobian = at.evaluation.jacobian;
  Eigen::MatrixXd stiffness =
      0.5 * (jacobian.block(n, n, n, n) + jacobian.block(2 * n, 2 * n, n, n));
  const double square = at.point.parameter * at.point.parameter;
  stiffness.diagonal().array() -= balance.scene().natural_frequency.array().square() - square;
  return stiffness;
}

/// d_k of each share.
std::vector<double> direct_responses(const HarmonicBalance& balance, const NewtonResult& at,
                                     const Harmonics& force,
                                     const std::vector<HarmonicShare>& shares) {
  const Scene& scene = balance.scene();
  const double amplitude =
      output_amplitude(balance.harmonics(at.point.x), scene.output).half_peak_to_peak;
  const Eigen::MatrixXd stiffness = mean_stiffness(balance, at);
  std::vector<double> direct;
  for (const HarmonicShare& share : shares) {
    const double frequency = share.order * at.point.parameter;
    Eigen::MatrixXcd matrix = stiffness.cast<std::complex<double>>();
    const auto& natural = scene.natural_frequency.array();
    matrix.diagonal().real().array() += natural.square() - frequency * frequency;
    matrix.diagonal().imag().array() += 2.0 * scene.damping_ratio.array() * natural * frequency;
    Eigen::VectorXcd right(scene.n_modes());
    right.real() = force.sine(share.order).transpose();
    right.imag() = force.cosine(share.order).transpose();
    direct.push_back(matrix.partialPivLu().solve(right).norm() / amplitude);
  }
  return direct;
}

}  // namespace

void HarmonicScreening::remember(const HarmonicBalance& balance, const NewtonResult& at,
                                 const HarmonicDecision& probe) {
  Memory memory{balance.set(), probe.shares, {}, probe.missing, probe.force.n_harmonics(), 0, 0};
  if (!skipped_.empty()) memory.n_partial = memory_->n_partial + 1;
  std::ranges::copy(skipped_, std::back_inserter(memory.shares));
  memory.direct = direct_responses(balance, at, probe.force, memory.shares);
  memory_ = std::move(memory);
}

void HarmonicScreening::choose_skips(const std::vector<double>& ratios) {
  if (memory_->n_partial >= most_uses) return;
  std::vector<HarmonicShare> shares = memory_->shares;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i].error *= ratios[i];
    shares[i].wave *= ratios[i];
    if (!std::isfinite(shares[i].error)) return;
  }
  std::ranges::stable_sort(shares, {}, &HarmonicShare::error);
  for (HarmonicShare& share : shares) {
    const double error = skips_.error + skipped_margin * share.error;
    if (error > skipped_share * choice_.allowed()) break;
    skips_.error = error;
    skips_.orders.push_back(share.order);
    skipped_.push_back(std::move(share));
  }
}

std::optional<double> HarmonicScreening::missing(const HarmonicBalance& balance,
                                                 const NewtonResult& at, double scale) {
  skips_ = {};
  skipped_.clear();
  if (!memory_ || memory_->set != balance.set() || memory_->uses >= most_uses) return std::nullopt;
  if (choice_.probed(balance.set(), at.point.parameter) > memory_->highest) return std::nullopt;
  ++memory_->uses;
  const Harmonics force = scene_.contact->force_up_to(balance.harmonics(at.point.x),
                                                      at.point.parameter, memory_->highest);
  // A harmonic that was silent has no share to be taken over.
  for (const int order : HarmonicChoice::heard(balance.set(), force, scale)) {
    const bool known = std::any_of(memory_->shares.begin(), memory_->shares.end(),
                                   [&](const HarmonicShare& share) { return share.order == order; });
    if (!known) return std::nullopt;
  }
  if (memory_->shares.empty()) return 0.0;
  const std::vector<double> direct = direct_responses(balance, at, force, memory_->shares);
  std::vector<double> ratios;
  double sum = 0.0;
  double changed = memory_->missing;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    ratios.push_back(direct[i] / memory_->direct[i]);
    sum += memory_->shares[i].error * ratios.back();
    changed += memory_->shares[i].error * std::abs(ratios.back() - 1.0);
  }
  const double missing = std::min(sum, changed);
  // What is not a number asks for a probe as well.
  if (std::pow(margin, memory_->uses) * missing <= choice_.allowed()) return missing;
  choose_skips(ratios);
  return std::nullopt;
}

}  // namespace microslip::solver
