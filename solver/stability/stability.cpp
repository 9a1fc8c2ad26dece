#include "solver/stability/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "contact/dense.hpp"
#include "solver/balance/condensed.hpp"
#include "solver/stability/floquet.hpp"

namespace microslip::solver {
namespace {

// Eigenvalues of a matrix whose entries are of the size of ω carry errors of some 1e-13 ω; a growth
// below this share of ω takes over 1e9 periods to show.
constexpr double growth_tolerance = 1e-10;
// Slow flow holds for what is slow against the cycle. Modes far from resonance turn at |ω_n ± ω| in
// it, and the mean at ω_n: a hysteretic force answers those in another way, so they are not judged.
constexpr double slow_share = 0.25;  // of ω
// Of Hill's problem: some 1 ms for its eigenvalues, twice that with all their vectors.
constexpr Eigen::Index most_states = 80;
// Of ω, natural frequencies of modes that tell the width of a resonance: others answer like
// springs.
constexpr double reach_of_width = 6.0;
// Of a motion: perturbations that stay as small, as they do where energy falls.
constexpr double nearby = 1e-6;
// Of ω: a double eigenvalue splits by the root of its rounding error, some 1e-8.
constexpr double real_tolerance = 1e-6;
// Of a monodromy matrix, where every point is judged: three periods of 0.1 to 1 ms. Of points that
// slide in a plane, or whose coefficient or load follows a law of its own, two periods for each
// column, ten times as long each: nine tenths of a curve.
constexpr Eigen::Index most_multipliers = 16;
// The same where few points are judged: sliders at rest in the period are no states of the matrix,
// points cost time in each of its columns (10 modes: 0.3 s with 12 points, 2 s with 100).
constexpr Eigen::Index most_multipliers_of_few = 60;
constexpr Eigen::Index most_points_of_few = 60;
// Of |μ|: differences of the period map err by 1e-5 where it is smooth, more where events graze.
constexpr double multiplier_tolerance = 1e-4;

/// The first two, and harmonics at which a mode is slow against the cycle.
std::vector<int> slow_orders(const HarmonicBalance& balance, double frequency) {
  std::vector<int> kept;
  for (const int k : balance.set().orders()) {
    const Eigen::ArrayXd turn = balance.scene().natural_frequency.array() - k * frequency;
    if (kept.size() < 2 || (turn.abs() < slow_share * frequency).any()) kept.push_back(k);
  }
  return kept;
}

std::vector<Eigen::Index> all_modes(const Scene& scene) {
  std::vector<Eigen::Index> modes(static_cast<std::size_t>(scene.n_modes()));
  std::iota(modes.begin(), modes.end(), Eigen::Index{0});
  return modes;
}

/// Modes that move by themselves: the low ones, and those near a harmonic.
/// Others follow like springs.
std::vector<Eigen::Index> moving_modes(const HarmonicBalance& balance, double frequency) {
  const Eigen::VectorXd& natural = balance.scene().natural_frequency;
  std::vector<Eigen::Index> modes;
  for (Eigen::Index i = 0; i < natural.size(); ++i) {
    bool moves = natural[i] <= reach_of_width * frequency;
    for (const int k : balance.set().orders()) {
      moves = moves || std::abs(natural[i] - k * frequency) < slow_share * frequency;
    }
    if (moves) modes.push_back(i);
  }
  return modes.empty() ? all_modes(balance.scene()) : modes;
}

/// As many as Hill's problem can hold.
std::vector<int> low_orders(std::vector<int> orders, std::size_t n_modes) {
  const auto room = static_cast<std::size_t>(most_states) / (4 * n_modes);
  orders.resize(std::min(orders.size(), std::max<std::size_t>(room, 2)));
  return orders;
}

template <typename Number>
std::vector<Number> united(const std::vector<Number>& a, const std::vector<Number>& b) {
  std::vector<Number> all;
  std::ranges::set_union(a, b, std::back_inserter(all));
  return all;
}

/// @param orders, modes  to be kept, ascending.
ReducedBalance reduced(const HarmonicBalance& balance, const BalanceJacobian& jacobian,
                       std::vector<int> orders, std::vector<Eigen::Index> modes) {
  ReducedBalance result{balance.has_mean(), std::move(orders), std::move(modes), {}};
  std::vector<Eigen::Index> low;
  if (result.has_mean) low = result.modes;
  const Eigen::Index n = balance.scene().n_modes();
  Eigen::Index first = balance.orders_begin();
  for (const int k : balance.set().orders()) {
    const bool is_kept = std::binary_search(result.orders.begin(), result.orders.end(), k);
    for (const Eigen::Index end = first + 2 * n; first < end; first += n) {
      if (!is_kept) continue;
      for (const Eigen::Index mode : result.modes) low.push_back(first + mode);
    }
  }
  result.jacobian = schur_complement(jacobian, low);
  return result;
}

/// To what the slow flow and Hill's problem ask for.
ReducedBalance reduced(const HarmonicBalance& balance, const BalanceJacobian& jacobian,
                       double frequency) {
  const bool single = balance.set().highest() == 1;
  std::vector<Eigen::Index> modes =
      single ? all_modes(balance.scene()) : moving_modes(balance, frequency);
  std::vector<int> orders =
      united(slow_orders(balance, frequency), low_orders(balance.set().orders(), modes.size()));
  return reduced(balance, jacobian, std::move(orders), std::move(modes));
}

/// Of a motion that changes sign after half a period: the mean and the first even harmonics.
/// Nothing couples odd perturbations and even ones, and an exponent of one is that of the other
/// shifted by the frequency: those centred on harmonic 0 are even.
ReducedBalance even_part(const Scene& scene, const Harmonics& q, double frequency,
                         std::vector<Eigen::Index> modes) {
  std::vector<int> orders;
  for (int k = 2; k <= q.n_harmonics(); k += 2) orders.push_back(k);
  {
    const HarmonicBalance all(scene, HarmonicSet(orders));
    modes = united(modes, moving_modes(all, frequency));
  }
  orders = low_orders(std::move(orders), modes.size());
  HarmonicBalance even(scene, HarmonicSet(orders));
  return reduced(even, even.derivatives_at(q, frequency), std::move(orders), std::move(modes));
}

/// @param orders  some of those that it has.
ReducedBalance with_orders(const ReducedBalance& balance, const std::vector<int>& orders) {
  if (orders == balance.orders) return balance;
  const auto n = static_cast<Eigen::Index>(balance.modes.size());
  std::vector<Eigen::Index> low(balance.has_mean ? balance.modes.size() : 0);
  std::iota(low.begin(), low.end(), Eigen::Index{0});
  auto first = static_cast<Eigen::Index>(low.size());
  for (const int k : balance.orders) {
    for (Eigen::Index i = first; i < first + 2 * n; ++i) {
      if (std::binary_search(orders.begin(), orders.end(), k)) low.push_back(i);
    }
    first += 2 * n;
  }
  return {balance.has_mean, orders, balance.modes, schur_complement(balance.jacobian, low)};
}

/// Of the modes kept.
Eigen::VectorXd damping_of(const Scene& scene, const ReducedBalance& balance) {
  return 2.0 *
         scene.damping_ratio(balance.modes).cwiseProduct(scene.natural_frequency(balance.modes));
}

/// States (B, A^(1), …, A^(H), Ḃ): −M⁻¹ ∂R/∂x for the harmonics, second order for the mean, where
/// that is unknown.
Eigen::MatrixXd slow_flow(const Scene& scene, const ReducedBalance& balance, double frequency) {
  const auto n = static_cast<Eigen::Index>(balance.modes.size());
  const Eigen::MatrixXd& jacobian = balance.jacobian;
  const Eigen::Index size = jacobian.rows();
  const Eigen::VectorXd damping = damping_of(scene, balance);
  Eigen::Index s = balance.has_mean ? n : 0;
  Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(size + s, size + s);
  flow.block(0, size, s, s).setIdentity();
  flow.block(size, 0, s, size) = -jacobian.topRows(s);
  flow.block(size, size, s, s).diagonal() = -damping.head(s);
  for (const int k : balance.orders) {
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

/// Hill's problem as a first-order one in (p, λp/ω), eigenvalues over ω.
Eigen::MatrixXd hill_matrix(const Scene& scene, const ReducedBalance& balance, double frequency) {
  const auto n = static_cast<Eigen::Index>(balance.modes.size());
  const Eigen::Index size = balance.jacobian.rows();
  const Eigen::VectorXd damping = damping_of(scene, balance) / frequency;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * size, 2 * size);
  matrix.topRightCorner(size, size).setIdentity();
  matrix.bottomLeftCorner(size, size) = -balance.jacobian / (frequency * frequency);
  auto delta = matrix.bottomRightCorner(size, size);  // −Δ/ω
  delta.diagonal() = -damping.replicate(size / n, 1);
  Eigen::Index s = balance.has_mean ? n : 0;
  for (const int k : balance.orders) {
    delta.block(s, s + n, n, n).diagonal().setConstant(2.0 * k);
    delta.block(s + n, s, n, n).diagonal().setConstant(-2.0 * k);
    s += 2 * n;
  }
  return matrix;
}

/// Mean harmonic of an eigenvector, from −H to H: S sin kθ + C cos kθ has (C ∓ iS)/2 at ±k.
double centre_of(const Eigen::VectorXcd& p, const ReducedBalance& balance) {
  constexpr std::complex<double> i{0.0, 1.0};
  const auto n = static_cast<Eigen::Index>(balance.modes.size());
  Eigen::Index s = balance.has_mean ? n : 0;
  double moment = 0.0;
  double size = p.head(s).squaredNorm();
  for (const int k : balance.orders) {
    const auto sine = p.segment(s, n);
    const auto cosine = p.segment(s + n, n);
    const double ahead = 0.25 * (cosine - i * sine).squaredNorm();
    const double behind = 0.25 * (cosine + i * sine).squaredNorm();
    moment += k * (ahead - behind);
    size += ahead + behind;
    s += 2 * n;
  }
  return moment / size;
}

/// A resonance near by is a pair −d ± i(ω_r − ω), or, close to it, two real values of which one
/// vanishes at a fold: there the other one tells the width.
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

/// Whether a matrix is symmetric without negative eigenvalues,
/// up to rounding of the sum that made it.
bool is_spring(const Eigen::MatrixXd& stiffness) {
  constexpr double rounding = 1e-12;  // of the norm: sums over some thousand points
  const double least = rounding * stiffness.norm();
  if (!((stiffness - stiffness.transpose()).norm() <= least)) return false;
  const auto values = contact::symmetric_eigenvalues(stiffness);
  return values && values->minCoeff() >= -least;
}

/// q̈ + C q̇ + (Ω + S) q with C, Ω > 0 and S ≥ 0, for all motions of a ball: the energy of a
/// perturbation falls until it is at rest.
bool is_damped_linear(const Scene& scene, const Harmonics& centre, double radius) {
  const bool damped =
      (scene.natural_frequency.array() > 0.0).all() && (scene.damping_ratio.array() > 0.0).all();
  if (!damped || !scene.contact) return damped;
  switch (scene.contact->linear_state(centre, radius)) {
    case contact::LinearState::free:
      return true;
    case contact::LinearState::stuck:
      return is_spring(scene.contact->stuck_stiffness());
    case contact::LinearState::unknown:
      break;
  }
  return false;
}

/// What is known without an exponent: a proof, one harmonic, a determinant that is negative.
std::optional<StabilityReport> without_exponents(const HarmonicBalance& balance, const Harmonics& q,
                                                 const StabilityReport& slow) {
  StabilityReport report = slow;
  const Scene& scene = balance.scene();
  // Of a motion that sticks throughout it takes a sum over the points, and no eigenvalues.
  const bool is_linear = damped_linear_stability(balance).has_value();
  const bool several = balance.set().highest() > 1;
  if (is_linear ||
      (several && scene.contact && is_damped_linear(scene, q, nearby * q.vector().norm()))) {
    report.stability = Stability::stable;
    report.basis = StabilityBasis::damped_linear;
    return report;
  }
  if (!several) return report;
  if (!(slow.determinant_sign < 0.0)) return std::nullopt;
  report.stability = Stability::unstable;
  if (balance.has_mean() || !balance.set().has_mean()) report.basis = StabilityBasis::hill;
  return report;
}

/// Hill's problem of some harmonics of some modes.
struct HillProblem {
  ReducedBalance low;
  Eigen::MatrixXd matrix;
};

HillProblem hill_problem(const HarmonicBalance& balance, const Harmonics& q, double frequency,
                         const ReducedBalance& slow) {
  const bool is_odd = !balance.set().has_mean();
  HillProblem problem{
      is_odd ? even_part(balance.scene(), q, frequency, slow.modes)
             : with_orders(slow, low_orders(balance.set().orders(), slow.modes.size())),
      {}};
  problem.matrix = hill_matrix(balance.scene(), problem.low, frequency);
  return problem;
}

/// Over ω. @return none: the eigenvectors do not converge.
std::optional<HillGrowth> growth_of(const HillProblem& problem) {
  const auto pairs = contact::general_pairs(problem.matrix);
  if (!pairs) return std::nullopt;
  const Eigen::MatrixXcd vectors = pairs->vectors.topRows(problem.low.jacobian.rows());
  // Exponents midway between two harmonics are conjugate pairs of copies of one another, centred as
  // far on either side: those on one side are taken, each once.
  // Others are best known, by as many harmonics above as below, as the pair nearest to harmonic 0.
  constexpr double aside = 0.01;
  std::vector<std::pair<double, Eigen::Index>> centres;
  for (Eigen::Index i = 0; i < problem.matrix.rows(); ++i) {
    centres.emplace_back(std::abs(centre_of(vectors.col(i), problem.low) - aside), i);
  }
  std::sort(centres.begin(), centres.end());
  HillGrowth growth;
  for (std::size_t i = 0; i < 2 * problem.low.modes.size(); ++i) {
    const std::complex<double> value = pairs->values[centres[i].second];
    const bool real = std::abs(value.imag() - std::round(value.imag())) < real_tolerance;
    growth.largest = std::max(growth.largest, value.real());
    if (real) growth.real = std::max(growth.real, value.real());
  }
  return growth;
}

/// Whether all that grows is far from harmonic 0: copies, cut off at the highest harmonic.
bool only_copies_grow(const HillProblem& problem) {
  constexpr double far = 0.75;
  const auto grows = [](std::complex<double> value) { return value.real() > growth_tolerance; };
  const auto pairs = contact::general_pairs(problem.matrix, grows);
  if (!pairs) return false;
  const auto vectors = pairs->vectors.topRows(problem.low.jacobian.rows());
  for (Eigen::Index i = 0; i < pairs->values.size(); ++i) {
    const bool is_near =
        grows(pairs->values[i]) && !(std::abs(centre_of(vectors.col(i), problem.low)) >= far);
    if (is_near) return false;
  }
  return true;
}

/// What without_exponents() leaves open, by Hill's exponents.
StabilityReport by_exponents(const HarmonicBalance& balance, const Harmonics& q, double frequency,
                             StabilityReport slow) {
  if (balance.set().has_mean() && !balance.has_mean()) return slow;
  StabilityReport report = std::move(slow);
  report.stability = Stability::not_assessed;
  report.basis = StabilityBasis::hill;
  const HillProblem problem = hill_problem(balance, q, frequency, *report.reduced);
  if (!problem.matrix.allFinite()) return report;
  // Where nothing grows but copies, nothing is to be sorted: less than half the cost.
  const auto growth = only_copies_grow(problem) ? HillGrowth{} : growth_of(problem);
  if (growth && growth->real > growth_tolerance) {
    report.stability = Stability::unstable;
  } else if (growth && growth->largest <= growth_tolerance) {
    report.stability = Stability::stable;
  }
  return report;
}

/// Whether the period map may cost what it does.
bool is_in_reach(const Scene& scene, PeriodMapEffort effort) {
  if (!scene.transient) return false;
  const Eigen::Index n_points = scene.transient->n_points();
  if (effort == PeriodMapEffort::few_points) return n_points <= most_points_of_few;
  return scene.transient->n_internal() == 0 && 2 * scene.n_modes() + n_points <= most_multipliers;
}

struct VerdictInTime {
  Stability stability = Stability::not_assessed;  ///< by multipliers that are not real and positive
  bool has_real_growth = false;                   ///< by those that are
};

/// @return none: the map is not known.
std::optional<VerdictInTime> verdict_in_time(const Scene& scene, const Harmonics& q,
                                             double frequency, PeriodMapEffort effort) {
  const bool few = effort == PeriodMapEffort::few_points;
  const FloquetMultipliers floquet =
      floquet_multipliers(scene, frequency, q, few ? most_multipliers_of_few : most_multipliers);
  if (!floquet.known()) return std::nullopt;
  const double unsure = std::max(multiplier_tolerance, floquet.distance);
  const double beyond = floquet.largest_oscillating() - 1.0;
  VerdictInTime verdict;
  verdict.has_real_growth = floquet.multipliers.cwiseAbs().maxCoeff() > 1.0 + unsure;
  if (beyond > unsure) verdict = {Stability::unstable, false};
  if (beyond < -unsure) verdict.stability = Stability::stable;
  return verdict;
}

}  // namespace

StabilityReport slow_flow_stability(const HarmonicBalance& balance, const BalanceJacobian& jacobian,
                                    double frequency, std::optional<double> determinant_sign) {
  StabilityReport report;
  report.determinant_sign = determinant_sign ? *determinant_sign : sign_of_determinant(jacobian);
  report.reduced = std::make_shared<const ReducedBalance>(reduced(balance, jacobian, frequency));
  const Scene& scene = balance.scene();
  const Eigen::MatrixXd flow =
      slow_flow(scene, with_orders(*report.reduced, slow_orders(balance, frequency)), frequency);
  if (!flow.allFinite()) return report;
  const auto values = contact::general_eigenvalues(flow);
  if (!values) return report;
  report.nearest = nearest_resonance(*values);
  report.growth = -std::numeric_limits<double>::infinity();
  for (const auto& value : *values) {
    if (std::abs(value.imag()) < slow_share * frequency) {
      report.growth = std::max(report.growth, value.real());
    }
  }
  const bool grows = report.growth > growth_tolerance * frequency;
  report.stability =
      grows || report.determinant_sign < 0.0 ? Stability::unstable : Stability::stable;
  return report;
}

std::optional<StabilityReport> damped_linear_stability(const HarmonicBalance& balance) {
  const Harmonics rest(1, balance.scene().n_modes());
  if (!is_damped_linear(balance.scene(), rest, std::numeric_limits<double>::infinity())) return {};
  return StabilityReport{Stability::stable, StabilityBasis::damped_linear, 1.0};
}

StabilityReport hill_stability(const HarmonicBalance& balance, const Harmonics& q, double frequency,
                               StabilityReport slow) {
  if (const auto settled = without_exponents(balance, q, slow)) return *settled;
  return by_exponents(balance, q, frequency, std::move(slow));
}

std::optional<HillGrowth> hill_growth(const HarmonicBalance& balance, const Harmonics& q,
                                      double frequency, const ReducedBalance& reduced) {
  const HillProblem problem = hill_problem(balance, q, frequency, reduced);
  auto growth = problem.matrix.allFinite() ? growth_of(problem) : std::nullopt;
  if (growth) *growth = {growth->largest * frequency, growth->real * frequency};
  return growth;
}

StabilityReport stability_in_time(const HarmonicBalance& balance, const Harmonics& q,
                                  double frequency, StabilityReport hill, PeriodMapEffort effort) {
  if (balance.set().highest() == 1 || !is_in_reach(balance.scene(), effort)) return hill;
  if (hill.basis == StabilityBasis::damped_linear) return hill;
  if (hill.stability == Stability::unstable) return hill;
  const auto map = verdict_in_time(balance.scene(), q, frequency, effort);
  if (!map) return hill;
  hill.basis = StabilityBasis::period_map;
  hill.stability = map->stability;
  return hill;
}

StabilityReport judged_stability(const HarmonicBalance& balance, const Harmonics& q,
                                 double frequency, StabilityReport slow, PeriodMapEffort effort) {
  if (auto settled = without_exponents(balance, q, slow)) return std::move(*settled);
  if (!is_in_reach(balance.scene(), PeriodMapEffort::every_point)) {
    return stability_in_time(balance, q, frequency,
                             by_exponents(balance, q, frequency, std::move(slow)), effort);
  }
  const auto map = verdict_in_time(balance.scene(), q, frequency, effort);
  StabilityReport report = slow;
  if (!map || map->has_real_growth) {
    report = by_exponents(balance, q, frequency, std::move(slow));
    if (!map || report.stability == Stability::unstable) return report;
  }
  report.basis = StabilityBasis::period_map;
  report.stability = map->stability;
  return report;
}

StabilityReport assess_stability(const HarmonicBalance& balance, const BalanceJacobian& jacobian,
                                 const Harmonics& q, double frequency) {
  return hill_stability(balance, q, frequency, slow_flow_stability(balance, jacobian, frequency));
}

}  // namespace microslip::solver
