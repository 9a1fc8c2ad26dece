#include "solver/time/time_guards.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace microslip::solver {
namespace {

using contact::TransientForce;

constexpr std::size_t n_samples = 5;
constexpr std::array<double, n_samples> sample_at{0.0, 0.25, 0.5, 0.75, 1.0};
/// Events closer than this, in steps, are one.
constexpr double simultaneous = 1e-12;

/// Memory with the internal variables of any instant of a segment.
class MemoryAlong {
 public:
  MemoryAlong(const TimeSegment& segment, contact::TransientMemory memory)
      : segment_(segment), memory_(std::move(memory)) {}
  const contact::TransientMemory& at(double x) {
    if (segment_.has_internal()) memory_.internal = segment_.internal_at(x);
    return memory_;
  }

 private:
  const TimeSegment& segment_;
  contact::TransientMemory memory_;
};

/// One guard of one point along a segment, raised by the tolerance.
struct GuardAlong {
  const TransientForce& contact;
  const TimeSegment& segment;
  MemoryAlong& memory;
  const contact::GuardScale& scale;
  Eigen::Index point;
  std::size_t guard;

  double operator()(double x) const {
    return contact.guards_of(point, segment.at(x), memory.at(x), scale)[guard] + guard_tolerance;
  }
};

bool is_root(double value) { return std::abs(value) <= 0.1 * guard_tolerance; }

/// Root of g in [low, high], g(low) > 0 ≥ g(high): regula falsi with halved weights (Illinois),
/// every third step a bisection. The result is not positive,
/// or positive by less than a tenth of the tolerance.
double bracketed_root(const GuardAlong& g, double low, double high, double g_low, double g_high) {
  for (int i = 1; i < 200; ++i) {
    if (high - low <= std::numeric_limits<double>::epsilon() * high) break;
    double x = i % 3 == 0 ? 0.5 * (low + high) : (low * g_high - high * g_low) / (g_high - g_low);
    if (!(x > low && x < high)) x = 0.5 * (low + high);
    const double value = g(x);
    if (is_root(value)) return x;
    if (value > 0.0) {
      low = x;
      g_low = value;
      g_high *= 0.5;
    } else {
      high = x;
      g_high = value;
      g_low *= 0.5;
    }
  }
  return high;
}

/// Minimum of g between two samples by golden sections, given up as soon as it is negative.
double descend(const GuardAlong& g, double low, double high) {
  constexpr double golden = 0.6180339887498949;
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double g_left = g(left);
  double g_right = g(right);
  for (int i = 0; i < 40 && g_left > 0.0 && g_right > 0.0; ++i) {
    if (g_left < g_right) {
      high = right;
      right = left;
      g_right = g_left;
      left = high - golden * (high - low);
      g_left = g(left);
    } else {
      low = left;
      left = right;
      g_left = g_right;
      right = low + golden * (high - low);
      g_right = g(right);
    }
  }
  return g_left < g_right ? left : right;
}

using Samples = std::array<double, n_samples>;

/// Whether the parabola through three neighbouring samples, the middle one lowest, falls below
/// zero; also when it nearly does, by a tenth of the drop, for a guard is not a parabola.
bool may_dip(const Samples& g, std::size_t middle) {
  const double before = g[middle - 1] - g[middle];
  const double after = g[middle + 1] - g[middle];
  if (before < 0.0 || after < 0.0 || before + after == 0.0) return false;
  const double slope = 0.5 * (after - before);
  const double drop = 0.5 * slope * slope / (before + after);
  return g[middle] - 1.1 * drop - 0.1 * std::max(before, after) <= 0.0;
}

constexpr double nowhere = 2.0;

/// As bracketed_root(), or nowhere if the root lies beyond `last`: one evaluation tells.
double root_until(const GuardAlong& g, double low, double high, double g_low, double g_high,
                  double last) {
  if (last < high) {
    const double value = g(last);
    if (is_root(value)) return last;  // that of an equal point
    if (value > 0.0) return nowhere;
    high = last;
    g_high = value;
  }
  return bracketed_root(g, low, high, g_low, g_high);
}

/// First x up to `last` at which a guard with these samples (tolerance added) is negative.
double first_violation(const GuardAlong& along, const Samples& g, double last) {
  if (g[0] < 0.0) return 0.0;
  for (std::size_t j = 1; j < n_samples && sample_at[j - 1] <= last; ++j) {
    if (g[j] < 0.0) {
      return root_until(along, sample_at[j - 1], sample_at[j], g[j - 1], g[j], last);
    }
    if (j + 1 < n_samples && g[j + 1] >= 0.0 && may_dip(g, j)) {
      const double bottom = descend(along, sample_at[j - 1], sample_at[j + 1]);
      const double value = along(bottom);
      if (value < 0.0) {
        return root_until(along, sample_at[j - 1], bottom, g[j - 1], value, last);
      }
    }
  }
  return nowhere;
}

}  // namespace

std::optional<TimeEvent> first_event(const TransientForce& contact, const TimeSegment& segment,
                                     const contact::TransientMemory& memory,
                                     const contact::GuardScale& scale) {
  using GuardRows = Eigen::Matrix<double, Eigen::Dynamic, TransientForce::guards_per_point>;
  std::array<GuardRows, n_samples> sampled;
  MemoryAlong along(segment, memory);
  for (std::size_t j = 0; j < n_samples; ++j) {
    sampled[j] = contact.guards(segment.at(sample_at[j]), along.at(sample_at[j]), scale);
  }
  struct Violation {
    double at;
    Eigen::Index point;
  };
  std::vector<Violation> violations;
  // Many points change in a step of a patch, and each change ends it: those after the first so far
  // are not looked for.
  double first = nowhere;
  for (Eigen::Index point = 0; point < contact.n_points(); ++point) {
    double at = nowhere;
    for (std::size_t guard = 0; guard < TransientForce::guards_per_point; ++guard) {
      Samples g{};
      for (std::size_t j = 0; j < n_samples; ++j) {
        g[j] = sampled[j](point, static_cast<Eigen::Index>(guard)) + guard_tolerance;
      }
      const double last = first + simultaneous;
      at = std::min(at, first_violation({contact, segment, along, scale, point, guard}, g, last));
    }
    if (at <= 1.0) violations.push_back({at, point});
    first = std::min(first, at);
  }
  if (violations.empty()) return std::nullopt;
  TimeEvent event{first, {}};
  for (const Violation& violation : violations) {
    if (violation.at <= first + simultaneous) event.points.push_back(violation.point);
  }
  return event;
}

std::optional<double> first_kink(const TransientForce& contact, const TimeSegment& segment) {
  // Of the width of a law: what a step leaves on the wrong side of a kink of its third derivative
  // changes the force by the cube of this. A step that ends on a kink ends within it.
  static constexpr double on_it = 1e-6;
  constexpr int n_halvings = 40;  // to 1e-12 of the step
  Eigen::VectorXd before = contact.kink_distances(segment.at(0.0));
  if (before.size() == 0) return std::nullopt;
  const auto crosses = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return ((a.array() > on_it && b.array() < -on_it) || (a.array() < -on_it && b.array() > on_it))
        .any();
  };
  for (std::size_t j = 1; j < n_samples; ++j) {
    const Eigen::VectorXd after = contact.kink_distances(segment.at(sample_at[j]));
    if (!crosses(before, after)) {
      before = after;
      continue;
    }
    double low = sample_at[j - 1];
    double high = sample_at[j];
    for (int i = 0; i < n_halvings; ++i) {
      const double middle = 0.5 * (low + high);
      const Eigen::VectorXd there = contact.kink_distances(segment.at(middle));
      const bool beyond = ((before.array() > on_it && there.array() < 0.0) ||
                           (before.array() < -on_it && there.array() > 0.0))
                              .any();
      (beyond ? high : low) = middle;
    }
    return high;
  }
  return std::nullopt;
}

}  // namespace microslip::solver
