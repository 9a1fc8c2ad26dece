#include "solver/harmonics/harmonic_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "solver/balance/output_amplitude.hpp"
#include "solver/branch/start_point.hpp"

namespace microslip::solver {
namespace {

constexpr double added_down_to = 0.5;   // of the tolerance
constexpr double dropped_up_to = 0.3;   // of the tolerance, with what is missing already
constexpr int probed_ahead = 4;         // harmonics beyond the highest of the set
// Forces fall with k² at least and displacements with k² more: a resonance at kω beyond this gains
// less than 1e-3 of the first harmonic even at a damping of 1e-2.
constexpr int farthest_resonance = 15;

// Of the force scale: what symmetry leaves of a harmonic is some 1e-15 of it, and a resonance of damping
// 1e-6 makes no more of this than 1e-6 of the amplitude.
constexpr double silent = 1e-12;

HarmonicSet least_set(const Scene& scene) {
  std::vector<int> orders{1};
  for (int k = 1; k <= scene.excitation.n_harmonics(); ++k) {
    const bool excited =
        scene.excitation.sine(k).norm() > 0.0 || scene.excitation.cosine(k).norm() > 0.0;
    if (excited) orders.push_back(k);
  }
  return HarmonicSet(std::move(orders));
}

double top_resonance(const Scene& scene) {
  Eigen::MatrixXd stiffness = scene.natural_frequency.array().square().matrix().asDiagonal();
  if (scene.contact) stiffness += scene.contact->stuck_stiffness();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

/// [∂R/∂x ∂R/∂ω; tᵀ] in unknowns that are not scaled.
Eigen::PartialPivLU<Eigen::MatrixXd> factors_of(const BalanceEvaluation& at,
                                                const Eigen::VectorXd& tangent_x,
                                                double tangent_parameter, const Scaling& scaling) {
  const Eigen::Index n = at.residual.size();
  Eigen::MatrixXd matrix(n + 1, n + 1);
  matrix.topLeftCorner(n, n) = at.jacobian * (scaling.x / scaling.residual);
  matrix.topRightCorner(n, 1) = at.parameter_derivative * (scaling.parameter / scaling.residual);
  matrix.bottomLeftCorner(1, n) = tangent_x.transpose();
  matrix(n, n) = tangent_parameter;
  return matrix.partialPivLu();
}

/// What a change of the unknowns does to the output; the mean does not change the amplitude.
HarmonicShare share_of(const HarmonicBalance& balance, int order, const Eigen::VectorXd& change,
               double amplitude) {
  HarmonicShare share{order, 0.0, balance.harmonics(change).rows() * balance.scene().output / amplitude};
  if (!share.wave.allFinite()) share.wave.setZero();  // singular equations tell nothing
  share.wave[0] = 0.0;
  for (Eigen::Index row = 1; row + 1 < share.wave.size(); row += 2) {
    share.error += std::hypot(share.wave[row], share.wave[row + 1]);
  }
  return share;
}

/// max_θ |y(θ)| on a grid that misses less than 2 % of the highest harmonic: half the difference of the
/// extrema of a signal changes by no more than this when y is added.
double largest_value(const Eigen::VectorXd& y) {
  const Eigen::Index highest = (y.size() - 1) / 2;
  const Eigen::Index n = 16 * highest;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double c = std::cos(phase);
    const double s = std::sin(phase);
    double re = 0.0;  // Σ (y_sk + i y_ck) e^{ikθ} by Horner's rule; its imaginary part is y
    double im = 0.0;
    for (Eigen::Index k = highest; k >= 1; --k) {
      const double x = re + y[2 * k - 1];
      const double z = im + y[2 * k];
      re = x * c - z * s;
      im = x * s + z * c;
    }
    largest = std::max(largest, std::abs(im));
  }
  return largest;
}

/// First of the 2n unknowns of each harmonic of a set.
std::vector<std::pair<int, Eigen::Index>> blocks_of(const HarmonicBalance& balance) {
  std::vector<std::pair<int, Eigen::Index>> blocks;
  const Eigen::Index n = balance.scene().n_modes();
  Eigen::Index first = n;
  for (const int k : balance.set().orders()) {
    blocks.emplace_back(k, first);
    first += 2 * n;
  }
  return blocks;
}

/// One Newton step of the wide equations for each harmonic that the balance leaves out.
std::vector<HarmonicShare> shares_left_out(const HarmonicBalance& balance, const HarmonicBalance& wide,
                                   const BalanceEvaluation& at,
                                   const Eigen::PartialPivLU<Eigen::MatrixXd>& factors,
                                   double amplitude, const Scaling& scaling) {
  const Eigen::Index size = 2 * balance.scene().n_modes();
  const int n_out = wide.set().count() - balance.set().count();
  Eigen::MatrixXd steps = Eigen::MatrixXd::Zero(wide.size() + 1, n_out);
  std::vector<int> orders;
  for (const auto& [order, first] : blocks_of(wide)) {
    if (balance.set().contains(order)) continue;
    steps.col(static_cast<Eigen::Index>(orders.size())).segment(first, size) =
        -at.residual.segment(first, size) / scaling.residual;
    orders.push_back(order);
  }
  steps = factors.solve(steps) * scaling.x;
  std::vector<HarmonicShare> shares;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    shares.push_back(share_of(wide, orders[i], steps.col(column).head(wide.size()), amplitude));
  }
  return shares;
}

double amplitude_of(const HarmonicBalance& balance, const Eigen::VectorXd& x) {
  return output_amplitude(balance.harmonics(x), balance.scene().output).half_peak_to_peak;
}

}  // namespace

HarmonicChoice::HarmonicChoice(const Scene& scene, double tolerance, int highest)
    : scene_(scene),
      tolerance_(tolerance),
      highest_(highest),
      least_(least_set(scene)),
      top_frequency_(top_resonance(scene)) {
  if (!(tolerance > 0.0) || highest < 1) {
    throw std::invalid_argument("harmonics: tolerance " + std::to_string(tolerance) +
                                " and highest " + std::to_string(highest) +
                                "; needs a tolerance above 0 and at least one harmonic");
  }
}

int HarmonicChoice::probed(const HarmonicSet& set, double frequency) const {
  const double resonance = std::ceil(std::min(top_frequency_ / frequency, 1.0 * farthest_resonance));
  // Beyond the highest allowed as well: what is left out there is told.
  return std::max(set.highest() + probed_ahead, static_cast<int>(resonance));
}

std::vector<int> HarmonicChoice::heard(const HarmonicSet& set, const Harmonics& force, double scale) {
  std::vector<int> orders;
  for (int k = 1; k <= force.n_harmonics(); ++k) {
    const double size = std::hypot(force.sine(k).norm(), force.cosine(k).norm());
    if (size > silent * scale && !set.contains(k)) orders.push_back(k);
  }
  return orders;
}

double HarmonicChoice::allowed() const { return added_down_to * tolerance_; }

HarmonicDecision HarmonicChoice::enlarged(const HarmonicBalance& balance, const BranchVector& point,
                                          const BranchVector& tangent, const Scaling& scaling,
                                          const HarmonicSkips& skips) const {
  HarmonicDecision decision{balance.set(), {}, skips.error, skips.error, {}, {}};
  const double amplitude = amplitude_of(balance, point.x);
  const int probe = probed(balance.set(), point.parameter);
  if (!scene_.contact || amplitude == 0.0) return decision;
  decision.force =
      scene_.contact->force_up_to(balance.harmonics(point.x), point.parameter, probe);
  std::vector<int> orders = heard(balance.set(), decision.force, scaling.residual);
  std::erase_if(orders, [&](int k) { return std::ranges::count(skips.orders, k) > 0; });
  const HarmonicBalance wide(scene_, balance.set().united(orders));
  if (wide.set() == balance.set()) return decision;
  const auto widened = [&](const Eigen::VectorXd& x) { return wide.unknowns(balance.harmonics(x)); };
  const BalanceEvaluation at = wide.evaluate(widened(point.x), point.parameter);
  const auto factors = factors_of(at, widened(tangent.x), tangent.parameter, scaling);
  decision.shares = shares_left_out(balance, wide, at, factors, amplitude, scaling);
  Eigen::VectorXd wave = Eigen::VectorXd::Zero(2 * wide.set().highest() + 1);
  for (const HarmonicShare& share : decision.shares) wave += share.wave;
  decision.missing = decision.left_out = skips.error + largest_value(wave);
  std::stable_sort(decision.shares.begin(), decision.shares.end(),
                   [](const HarmonicShare& a, const HarmonicShare& b) { return a.error > b.error; });
  for (const HarmonicShare& share : decision.shares) {
    if (decision.left_out <= allowed()) break;
    if (share.order > highest_) continue;
    decision.added.push_back(share.order);
    wave -= share.wave;
    decision.left_out = skips.error + largest_value(wave);
  }
  decision.set = decision.set.united(decision.added);
  return decision;
}

HarmonicDecision HarmonicChoice::reduced(const HarmonicBalance& balance,
                                         const NewtonResult& solution, const BranchVector& tangent,
                                         const Scaling& scaling, double missing) const {
  HarmonicDecision decision{balance.set(), {}, 0.0, missing, {}, {}};
  const Eigen::VectorXd& x = solution.point.x;
  const double amplitude = amplitude_of(balance, x);
  const double allowed = dropped_up_to * tolerance_ - missing;
  if (balance.set() == least_ || amplitude == 0.0 || !(allowed > 0.0)) return decision;
  const Eigen::Index size = 2 * scene_.n_modes();
  std::vector<std::pair<int, Eigen::Index>> blocks;
  for (const auto& [order, first] : blocks_of(balance)) {
    // The output loses at least what it has of the harmonic.
    const auto own = x.segment(first, size);
    const double lost = std::hypot(own.head(size / 2).dot(scene_.output),
                                   own.tail(size / 2).dot(scene_.output));
    if (!least_.contains(order) && lost <= allowed * amplitude) blocks.emplace_back(order, first);
  }
  if (blocks.empty()) return decision;
  const auto factors = factors_of(solution.evaluation, tangent.x, tangent.parameter, scaling);
  std::vector<HarmonicShare> shares;
  for (const auto& [order, first] : blocks) {
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(balance.size() + 1, size);
    right.middleRows(first, size).setIdentity();
    const Eigen::MatrixXd response = factors.solve(right);
    const Eigen::MatrixXd own = response.middleRows(first, size);
    const Eigen::VectorXd force = -own.partialPivLu().solve(x.segment(first, size));
    const Eigen::VectorXd change = response.topRows(balance.size()) * force;
    shares.push_back(share_of(balance, order, change, amplitude));
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const HarmonicShare& a, const HarmonicShare& b) { return a.error < b.error; });
  std::vector<int> kept = balance.set().orders();
  Eigen::VectorXd wave = Eigen::VectorXd::Zero(2 * balance.set().highest() + 1);
  for (const HarmonicShare& share : shares) {
    wave += share.wave;
    const double left_out = largest_value(wave);
    if (left_out > allowed) break;
    decision.left_out = left_out;
    kept.erase(std::find(kept.begin(), kept.end(), share.order));
  }
  decision.set = HarmonicSet(std::move(kept));
  return decision;
}

/// Newton with more harmonics from a solution with fewer.
NewtonResult widened(const Scene& scene, const HarmonicBalance& from, const HarmonicSet& set,
                     const NewtonResult& at, double tolerance, SettledSolution& count) {
  const HarmonicBalance larger(scene, set);
  NewtonOptions options;
  options.tolerance = tolerance;
  options.max_iterations = 40;
  NewtonResult next = solve_at(larger, larger.unknowns(from.harmonics(at.point.x)),
                               at.point.parameter, options);
  count.evaluations += next.evaluations;
  count.iterations += next.iterations;
  return next;
}

SettledSolution settle_harmonics(const HarmonicChoice& choice, const Scene& scene, HarmonicSet set,
                                 NewtonResult at, double tolerance) {
  SettledSolution result{std::move(set), std::move(at)};
  const double frequency = result.solution.point.parameter;
  for (;;) {
    const HarmonicBalance balance(scene, result.set);
    const Eigen::VectorXd& x = result.solution.point.x;
    const BranchVector hold{Eigen::VectorXd::Zero(x.size()), 1.0};
    const HarmonicDecision decision = choice.enlarged(balance, result.solution.point, hold,
                                                      natural_scaling(balance, x, frequency));
    ++result.evaluations;
    result.left_out = decision.missing;
    if (decision.added.empty()) return result;
    HarmonicSet wanted = decision.set;
    NewtonResult next = widened(scene, balance, wanted, result.solution, tolerance, result);
    if (!next.converged && decision.added.size() > 1) {
      wanted = result.set.united({decision.added.front()});
      next = widened(scene, balance, wanted, result.solution, tolerance, result);
    }
    if (!next.converged) {
      wanted = decision.set;
      StartPoint start = find_start(HarmonicBalance(scene, wanted), frequency, tolerance);
      result.evaluations += start.evaluations;
      result.iterations += start.iterations;
      result.settled = start.solution.has_value();
      if (!result.settled) return result;
      next = std::move(*start.solution);
    }
    result.solution = std::move(next);
    result.set = std::move(wanted);
  }
}

}  // namespace microslip::solver
