#include "solver/stability/floquet.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "contact/dense.hpp"
#include "solver/stability/period_variation.hpp"
#include "solver/time/time_stepper.hpp"

namespace microslip::solver {
namespace {

using contact::ContactState;

// Of the largest motion. Central differences of a period err by its square times the curvature of
// P, and by the step tolerance over it: some 1e-5.
constexpr double difference = 1e-4;
constexpr double step_tolerance = 1e-9;
// Where periods are not differenced: of instants at which states change.
constexpr double step_tolerance_of_instants = 1e-8;
// Multipliers nearer than this to the positive axis, in angle, count as real: a double one splits
// by the root of the error of M.
constexpr double real_angle = 1e-2;

// Differences follow two periods a coordinate, each point event by event: 600 coordinates times
// points take some two seconds.
constexpr Eigen::Index most_differences = 600;

bool has_linear_states(const TimeSystem& system) {
  return system.contact() == nullptr || system.contact()->is_held_linear();
}

TimeOptions period_options(const TimeSystem& system) {
  TimeOptions options;
  options.step_tolerance = has_linear_states(system) ? step_tolerance_of_instants : step_tolerance;
  return options;
}

/// Which points leave stick within a period, how far sliders get,
/// and which states are held how long.
class SliderWatch final : public TimeObserver {
 public:
  explicit SliderWatch(std::size_t n_points) : moves(n_points, false) {}
  void take(const TimeSegment& segment, double end, const TransientMemory& memory,
            double /*slip_work*/) override {
    for (std::size_t i = 0; i < moves.size(); ++i) {
      moves[i] = moves[i] || memory.state[i] != ContactState::stick;
    }
    if (memory.slider.size() > 0) reach = std::max(reach, memory.slider.cwiseAbs().maxCoeff());
    const bool goes_on = !parts.empty() && parts.back().memory.state == memory.state &&
                         parts.back().memory.slider == memory.slider;
    if (!goes_on) parts.push_back({0.0, memory, {}});
    parts.back().duration += end * segment.length();
    parts.back().end = segment.at(end);
  }

  /// Points on a line whose slider stays where it is but for a share of its reach count as stuck
  /// throughout.
  void forget_moves_below(double share) {
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const auto [least, most] = resting_places(i);
      if (!moves[i] || !(most - least <= share * reach)) continue;
      moves[i] = false;
      for (HeldPart& part : parts) part.memory.state[i] = ContactState::stick;
    }
  }

  std::vector<bool> moves;
  double reach = 0.0;  ///< largest |s| [m]
  std::vector<HeldPart> parts;

 private:
  /// Least and largest slider of a point while it is stuck;
  /// infinitely far apart where it separates or never sticks.
  [[nodiscard]] std::pair<double, double> resting_places(std::size_t point) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double least = infinity;
    double most = -infinity;
    for (const HeldPart& part : parts) {
      const ContactState state = part.memory.state[point];
      if (state == ContactState::separated) return {-infinity, infinity};
      if (state != ContactState::stick) continue;
      least = std::min(least, part.memory.slider[static_cast<Eigen::Index>(point)]);
      most = std::max(most, part.memory.slider[static_cast<Eigen::Index>(point)]);
    }
    if (least > most) return {-infinity, infinity};
    return {least, most};
  }
};

/// The part of a TimeState that perturbations are made of, in numbers of order one.
class Coordinates {
 public:
  Coordinates(const TimeState& at, const SliderWatch& watch, const contact::GuardScale& size)
      : n_modes_(at.motion.q.size()), size_(size), reach_(watch.reach), state_(at.memory.state) {
    const auto n_points = static_cast<Eigen::Index>(watch.moves.size());
    for (Eigen::Index i = 0; i < n_points; ++i) {
      const auto point = static_cast<std::size_t>(i);
      const bool stuck = state_[point] == ContactState::stick && watch.moves[point];
      for (Eigen::Index k = i; stuck && k < at.memory.slider.size(); k += n_points) {
        sliders_.push_back(k);
      }
      // In a plane the direction of slip is a state of its own, one per point.
      const bool turns =
          state_[point] == ContactState::slip && at.memory.internal.size() == n_points;
      if (turns) directions_.push_back(i);
    }
    if (reach_ == 0.0) sliders_.clear();
  }

  [[nodiscard]] Eigen::Index size() const {
    return 2 * n_modes_ + static_cast<Eigen::Index>(sliders_.size() + directions_.size());
  }

  /// What moved() does by 1 in every column.
  [[nodiscard]] Variation units(Eigen::Index n_points) const {
    Variation units{Eigen::MatrixXd::Zero(n_modes_, size()),
                    Eigen::MatrixXd::Zero(n_modes_, size()),
                    Eigen::MatrixXd::Zero(n_points, size())};
    units.q.leftCols(n_modes_).diagonal().setConstant(size_.displacement);
    units.velocity.middleCols(n_modes_, n_modes_).diagonal().setConstant(size_.velocity);
    Eigen::Index column = 2 * n_modes_;
    for (const Eigen::Index k : sliders_) units.slider(k, column++) = reach_;
    return units;
  }

  /// The changes as rows in numbers of order one.
  [[nodiscard]] Eigen::MatrixXd rows(const Variation& change) const {
    Eigen::MatrixXd rows(size(), change.q.cols());
    rows << change.q / size_.displacement, change.velocity / size_.velocity,
        change.slider(sliders_, Eigen::all) / reach_;
    return rows;
  }

  [[nodiscard]] TimeState moved(TimeState from, Eigen::Index column, double by) const {
    const Eigen::Index n = n_modes_;
    if (column < n) {
      from.motion.q[column] += by * size_.displacement;
    } else if (column < 2 * n) {
      from.motion.velocity[column - n] += by * size_.velocity;
    } else if (const auto k = static_cast<std::size_t>(column - 2 * n); k < sliders_.size()) {
      from.memory.slider[sliders_[k]] += by * reach_;
    } else {
      from.memory.internal[directions_[k - sliders_.size()]] += by;
    }
    return from;
  }

  /// b − a; empty where the states of the points have changed.
  [[nodiscard]] std::optional<Eigen::VectorXd> between(const TimeState& a,
                                                       const TimeState& b) const {
    if (a.memory.state != state_ || b.memory.state != state_) return std::nullopt;
    Eigen::VectorXd change(size());
    change.head(n_modes_) = (b.motion.q - a.motion.q) / size_.displacement;
    change.segment(n_modes_, n_modes_) = (b.motion.velocity - a.motion.velocity) / size_.velocity;
    Eigen::Index row = 2 * n_modes_;
    for (const Eigen::Index k : sliders_) {
      change[row++] = (b.memory.slider[k] - a.memory.slider[k]) / reach_;
    }
    for (const Eigen::Index k : directions_) {
      constexpr double turn = 2.0 * std::numbers::pi;
      change[row++] = std::remainder(b.memory.internal[k] - a.memory.internal[k], turn);
    }
    return change;
  }

 private:
  Eigen::Index n_modes_;
  contact::GuardScale size_;
  double reach_;
  std::vector<ContactState> state_;
  std::vector<Eigen::Index> sliders_;
  std::vector<Eigen::Index> directions_;
};

TimeState after_period(const TimeSystem& system, TimeState state) {
  make_stepper(system, period_options(system))->advance_period(state, nullptr);
  return state;
}

/// ∂P/∂x by differences; empty where a perturbed period ends in other states.
std::optional<Eigen::MatrixXd> differenced(const TimeSystem& system, const TimeState& at,
                                           const Coordinates& coordinates) {
  const Eigen::Index n = coordinates.size();
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index column = 0; column < n; ++column) {
    const auto change =
        coordinates.between(after_period(system, coordinates.moved(at, column, -difference)),
                            after_period(system, coordinates.moved(at, column, difference)));
    if (!change) return std::nullopt;
    matrix.col(column) = *change / (2.0 * difference);
  }
  return matrix;
}

/// ∂P/∂x of the period watched.
std::optional<Eigen::MatrixXd> varied(const TimeSystem& system, const Coordinates& coordinates,
                                      const std::vector<HeldPart>& parts,
                                      const TransientMemory& end) {
  const Eigen::Index n_points = system.contact() != nullptr ? system.contact()->n_points() : 0;
  return coordinates.rows(varied_period(system, parts, end, coordinates.units(n_points)));
}

/// Begins a period after q, so that sliders are where the motion itself leaves them.
FloquetMultipliers multipliers_near(const TimeSystem& system, const Harmonics& q,
                                    Eigen::Index most) {
  FloquetMultipliers result;
  TimeState at = state_on(system, q);
  const auto stepper = make_stepper(system, period_options(system));
  stepper->advance_period(at, nullptr);
  SliderWatch watch(at.memory.state.size());
  TimeState end = at;
  stepper->advance_period(end, &watch);
  const contact::GuardScale& size = stepper->levels().last;
  const Coordinates coordinates(at, watch, size);
  if (coordinates.size() > most) return result;
  const auto missed = coordinates.between(at, end);
  if (!missed) return result;
  result.distance = missed->norm();
  const bool is_linear = has_linear_states(system);
  const auto n_points = static_cast<Eigen::Index>(at.memory.state.size());
  if (!is_linear && coordinates.size() * n_points > most_differences) return result;
  // Sliders shake down to where the motion leaves them: what one still moves by then may be the
  // error of the series.
  if (is_linear) watch.forget_moves_below(result.distance);
  const auto matrix = is_linear
                          ? varied(system, Coordinates(at, watch, size), watch.parts, end.memory)
                          : differenced(system, at, coordinates);
  if (!matrix || !matrix->allFinite()) return result;
  if (const auto values = contact::general_eigenvalues(*matrix)) result.multipliers = *values;
  return result;
}

}  // namespace

double FloquetMultipliers::largest_oscillating() const {
  double largest = 0.0;
  for (const std::complex<double>& value : multipliers) {
    if (std::abs(std::arg(value)) > real_angle) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

FloquetMultipliers floquet_multipliers(const Scene& scene, double frequency, const Harmonics& q,
                                       Eigen::Index most) {
  if (2 * scene.n_modes() > most) return {};
  const TimeSystem system(scene, frequency);
  try {
    return multipliers_near(system, q, most);
  } catch (const TimeError&) {  // chatter: the period map is not known, as the result says
    return {};
  }
}

}  // namespace microslip::solver
