#include "pipelines/accuracy/limit_resonances.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "contact/dense.hpp"

namespace microslip::pipelines {
namespace {

Eigen::MatrixXd stiffness_of(const solver::Scene& scene, LimitName limit) {
  Eigen::MatrixXd total = scene.natural_frequency.array().square().matrix().asDiagonal();
  if (limit == LimitName::stuck && scene.contact) total += scene.contact->stuck_stiffness();
  return total;
}

/// Of a linear limit.
struct Resonances {
  Eigen::VectorXd frequency;  ///< [rad/s], ascending
  Eigen::MatrixXd shape;      ///< a column each, in modal coordinates
};

Resonances resonances(const solver::Scene& scene, LimitName limit) {
  const auto pairs = contact::symmetric_pairs(stiffness_of(scene, limit));
  if (!pairs) return {};
  return {pairs->values.cwiseMax(0.0).cwiseSqrt(), pairs->vectors};
}

/// Of the resonance of the other model that has most of this shape, over this one's: they may stand
/// in another order there.
double factor_of(const Resonances& own, Eigen::Index i, const Resonances& there,
                 const Eigen::MatrixXd& embedding) {
  if (there.frequency.size() == 0 || !(own.frequency[i] > 0.0)) return 1.0;
  Eigen::VectorXd shape = own.shape.col(i);
  if (embedding.size() > 0) shape = embedding * shape;
  Eigen::Index same = 0;
  (there.shape.transpose() * shape).cwiseAbs().maxCoeff(&same);
  return there.frequency[same] / own.frequency[i];
}

/// Of the resonance here that the other model's has most of; there is none: the other's.
double own_frequency(const Resonances& own, const Resonances& there, Eigen::Index i,
                     const Eigen::MatrixXd& embedding) {
  constexpr double most = 0.5;
  Eigen::VectorXd shape = there.shape.col(i);
  if (embedding.size() > 0) shape = embedding.transpose() * shape;
  Eigen::Index same = 0;
  const double share = (own.shape.transpose() * shape).cwiseAbs().maxCoeff(&same);
  return share > most ? own.frequency[same] : there.frequency[i];
}

/// Of the first harmonic of the stuck limit [m]; infinite at a resonance without damping.
double stuck_amplitude(const solver::Scene& scene, double place) {
  using std::complex_literals::operator""i;
  const Eigen::MatrixXd stiffness = stiffness_of(scene, LimitName::stuck);
  const Eigen::VectorXd damping = 2.0 * scene.damping_ratio.cwiseProduct(scene.natural_frequency);
  Eigen::MatrixXcd dynamic = stiffness.cast<std::complex<double>>();
  dynamic.diagonal() += (1i * place * damping).array().matrix();
  dynamic.diagonal().array() -= place * place;
  const Eigen::MatrixXcd force =
      (scene.excitation.cosine() - 1i * scene.excitation.sine()).transpose();
  const double answer =
      std::abs((scene.output.transpose() * contact::solved(dynamic, force)).value());
  return std::isfinite(answer) ? answer : std::numeric_limits<double>::infinity();
}

bool meets(const Range& range, double from, double to) {
  return std::min(from, to) <= range.high && std::max(from, to) >= range.low;
}

}  // namespace

Range range_of(const solver::ContinuationOptions& options) {
  const auto [low, high] = std::minmax(options.frequency_begin, options.frequency_end);
  return {low, high};
}

double resonance_change(const solver::Scene& own, const solver::OtherModel& with,
                        const Range& range, LimitName limit) {
  const Resonances without = resonances(own, limit);
  if (without.frequency.size() == 0) return 0.0;
  Eigen::Index nearest = 0;
  (without.frequency.array() - 0.5 * (range.low + range.high)).abs().minCoeff(&nearest);
  return factor_of(without, nearest, resonances(with.scene, limit), with.embedding) - 1.0;
}

double resonance_change(const solver::Scene& own, const solver::OtherModel& with,
                        const Range& range) {
  const double free = resonance_change(own, with, range, LimitName::free);
  const double stuck = resonance_change(own, with, range, LimitName::stuck);
  return std::abs(stuck) > std::abs(free) ? stuck : free;
}

double factor_of_nearest(const solver::Scene& own, const solver::OtherModel& with, double peak) {
  double distance = std::numeric_limits<double>::infinity();
  double factor = 1.0;
  for (const LimitName limit : {LimitName::free, LimitName::stuck}) {
    const Resonances without = resonances(own, limit);
    if (without.frequency.size() == 0) continue;
    Eigen::Index nearest = 0;
    const double apart = (without.frequency.array() - peak).abs().minCoeff(&nearest);
    if (apart >= distance) continue;
    distance = apart;
    factor = factor_of(without, nearest, resonances(with.scene, limit), with.embedding);
  }
  return factor;
}

bool resonates_only_with(const solver::Scene& own, const solver::OtherModel& with,
                         const Range& range, double above) {
  constexpr double hardly = 0.5;
  const Resonances there = resonances(with.scene, LimitName::stuck);
  const Resonances free = resonances(with.scene, LimitName::free);
  const Resonances here = resonances(own, LimitName::stuck);
  if (there.frequency.size() == 0 || here.frequency.size() == 0) return false;
  if (free.frequency.size() == 0) return false;
  for (Eigen::Index i = 0; i < there.frequency.size(); ++i) {
    const double place = there.frequency[i];
    if (!meets(range, free.frequency[i], place)) continue;
    const double answer = stuck_amplitude(with.scene, place);
    if (!(answer > above)) continue;
    // Another mode may answer at the same place, with and without.
    Eigen::Index nearest = 0;
    (here.frequency.array() - place).abs().minCoeff(&nearest);
    const double without =
        std::max(stuck_amplitude(own, own_frequency(here, there, i, with.embedding)),
                 stuck_amplitude(own, here.frequency[nearest]));
    if (hardly * answer > without) return true;
  }
  return false;
}

}  // namespace microslip::pipelines
