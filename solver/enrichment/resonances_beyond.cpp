#include "solver/enrichment/resonances_beyond.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/dense.hpp"
#include "solver/balance/condensed.hpp"
#include "solver/enrichment/enrichment.hpp"

namespace microslip::solver {
namespace {

constexpr double near_a_mode = 3.0;  // half bandwidths

/// From which answer on a harmonic counts.
struct Least {
  double motion = 0.0;  ///< [m √kg]
  double output = 0.0;  ///< [m]
};

/// The modes with the contact free, and stuck: the same one of both by their order.
struct Limits {
  contact::SymmetricPairs free, stuck;
};

std::optional<Limits> limits_of(HarmonicBalance& balance) {
  const Scene& scene = balance.scene();
  Eigen::MatrixXd stiffness = scene.natural_frequency.cwiseAbs2().asDiagonal();
  auto free = contact::symmetric_pairs(stiffness);
  stiffness += balance.stuck_stiffness();
  auto stuck = contact::symmetric_pairs(stiffness);
  if (!free || !stuck) return std::nullopt;
  return Limits{std::move(*free), std::move(*stuck)};
}

/// Whether a mode, wherever it is between its limits, may answer one harmonic of a force.
class MayAnswer {
 public:
  MayAnswer(const Scene& scene, const Limits& limits, const Least& least)
      : scene_(scene), limits_(limits), least_(least) {
    rates_ = 2.0 * scene.damping_ratio.cwiseProduct(scene.natural_frequency);
  }

  [[nodiscard]] bool operator()(Eigen::Index j, double frequency, const Harmonics& force,
                                int k) const {
    const double lowest = std::sqrt(std::max(0.0, limits_.free.values[j]));
    const double highest = std::sqrt(std::max(0.0, limits_.stuck.values[j]));
    const double away = std::max({0.0, lowest - frequency, frequency - highest});
    return std::ranges::any_of(std::array{&limits_.free, &limits_.stuck}, [&](const auto* modes) {
      const Eigen::VectorXd shape = modes->vectors.col(j);
      const double rate = shape.cwiseAbs2().dot(rates_);  // 2 ζ_j ω_j
      if (away > near_a_mode * 0.5 * rate) return false;
      const double drive = std::hypot(force.sine(k).dot(shape), force.cosine(k).dot(shape));
      const double seen = std::abs(shape.dot(scene_.output));
      const double resists = rate * frequency;
      return drive > least_.motion * resists || seen * drive > least_.output * resists;
    });
  }

 private:
  const Scene& scene_;
  const Limits& limits_;
  Least least_;
  Eigen::VectorXd rates_;
};

std::vector<int> candidates(HarmonicBalance& balance, const LocalPeak& peak, int reach,
                            const Least& least) {
  const std::optional<Limits> limits = limits_of(balance);
  if (!limits) return {};  // not finite: nothing is known of it
  const Harmonics force = balance.contact_force(peak.point.x, peak.point.parameter, reach);
  const MayAnswer may_answer(balance.scene(), *limits, least);
  std::vector<int> orders;
  for (int k = balance.set().highest() + 1; k <= reach; ++k) {
    for (Eigen::Index j = 0; j < balance.scene().n_modes(); ++j) {
      if (!may_answer(j, k * peak.point.parameter, force, k)) continue;
      orders.push_back(k);
      break;
    }
  }
  return orders;
}

}  // namespace

std::vector<int> resonances_beyond(HarmonicBalance& balance, const LocalPeak& peak, int reach,
                                   double least) {
  if (!balance.scene().contact || reach <= balance.set().highest()) return {};
  const Harmonics own = balance.harmonics(peak.point.x);
  const Least counts{least * std::hypot(own.sine(1).norm(), own.cosine(1).norm()),
                     least * peak.amplitude};
  std::vector<int> orders = candidates(balance, peak, reach, counts);
  if (orders.empty()) return orders;
  HarmonicBalance richer(balance.scene(), balance.set().united(orders));
  const LocalPeak start = embedded(peak, balance, richer);
  const BalanceEvaluation at = richer.evaluate(start.point.x, start.point.parameter);
  const BranchVector step = newton_step(at, border_of(start), start.scaling);
  if (!step.x.allFinite()) return orders;  // what they do is not known
  const Harmonics answer = richer.harmonics(step.x);
  const Eigen::VectorXd& output = balance.scene().output;
  std::erase_if(orders, [&](int k) {
    const double motion = std::hypot(answer.sine(k).norm(), answer.cosine(k).norm());
    const double seen = std::hypot(answer.sine(k).dot(output), answer.cosine(k).dot(output));
    return motion <= counts.motion && seen <= counts.output;
  });
  return orders;
}

}  // namespace microslip::solver
