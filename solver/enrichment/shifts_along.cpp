#include "solver/point_shift.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "solver/balance/harmonic_balance.hpp"

namespace microslip::solver {
namespace {

constexpr double least_amplitude = 3e-4;  // of shifts that matter
constexpr double least_frequency = 1e-5;
constexpr int next_few = 6;        // those beyond move a point by less
constexpr double nothing = 1e-12;  // of the largest: what symmetry leaves of a harmonic's force

/// A point takes about as long as tracing it with the harmonics asked would; of small scenes the
/// whole is below a second.
struct Density {
  std::size_t stride;
  std::size_t at_most_one_in;  ///< beside those
};
constexpr Density fine{8, 4};
constexpr Density coarse{16, 12};
constexpr Eigen::Index many_unknowns = 150;

/// @param highest  harmonic that is asked.
Density density_of(const ResponseCurve& curve, int highest) {
  if (curve.points.empty()) return fine;
  const contact::Harmonics& q = curve.points.front().q;
  const int asked = std::min(highest, q.n_harmonics() + next_few);
  return (2 * asked + 1) * q.rows().cols() < many_unknowns ? fine : coarse;
}

struct ToldShift {
  std::size_t point = 0;
  PointShift shift;
};

/// Those of the curve, and of the next the ones that its contact has a force of.
HarmonicSet richer_set(const Scene& scene, const ResponsePoint& point, int highest) {
  const HarmonicSet own(point.orders);
  HarmonicBalance balance(scene, own);
  const int last = std::min(highest, own.highest() + next_few);
  const Harmonics force = balance.contact_force(balance.unknowns(point.q), point.frequency, last);
  const double least = nothing * force.vector().norm();
  std::vector<int> orders;
  for (int k = 1; k <= std::min(last, force.n_harmonics()); ++k) {
    const bool acts = std::hypot(force.sine(k).norm(), force.cosine(k).norm()) > least;
    if (acts && !own.contains(k)) orders.push_back(k);
  }
  return own.united(orders);
}

PointShift size_of(const PointShift& shift, const PointShift& most) {
  return {std::min(most.frequency, std::abs(shift.frequency)),
          std::min(most.amplitude, std::abs(shift.amplitude))};
}

/// Its size. Where nothing is found, what one step tells, within what it may be good for.
std::optional<PointShift> told_shift(const Scene& scene, const ResponsePoint& point, int highest) {
  constexpr PointShift most{0.1, 1.0};  // what is farther is another branch
  constexpr PointShift most_by_step{0.01, 0.3};
  const HarmonicSet set = richer_set(scene, point, highest);
  if (set.orders() == HarmonicSet(point.orders).orders()) return PointShift{};
  if (const auto solved = point_shift(scene, set, point, true)) return size_of(*solved, most);
  const auto step = point_shift(scene, set, point, false);
  return step ? std::optional(size_of(*step, most_by_step)) : std::nullopt;
}

bool differ(double a, double b, double least) {
  constexpr double alike = 2.0;
  return std::max(a, b) > std::max(least, alike * std::min(a, b));
}

/// Points that are looked at: more where the shifts of two neighbours differ.
class Samples {
 public:
  Samples(const Scene& scene, const ResponseCurve& curve, int highest,
          const std::function<bool()>& stop)
      : scene_(scene),
        curve_(curve),
        highest_(highest),
        stop_(stop),
        asked_(curve.points.size(), false) {
    const std::size_t n = curve.points.size();
    const Density density = density_of(curve, highest);
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_marked = curve.points[i].mark != PointMark::none;
      if (i % density.stride == 0 || i + 1 == n || is_marked) add(i);
    }
    left_ = n / density.at_most_one_in;
    while (left_ > 0 && is_finer()) {
    }
  }

  /// In the order of the points.
  [[nodiscard]] const std::vector<ToldShift>& told() const { return told_; }

 private:
  void add(std::size_t i) {
    if (asked_[i] || (stop_ && stop_())) return;
    asked_[i] = true;
    const auto shift = told_shift(scene_, curve_.points[i], highest_);
    if (shift) told_.push_back({i, *shift});
  }

  [[nodiscard]] bool is_finer() {
    const std::vector<ToldShift> before = told_;
    for (std::size_t i = 0; i + 1 < before.size() && left_ > 0; ++i) {
      const ToldShift& a = before[i];
      const ToldShift& b = before[i + 1];
      const bool asked = differ(a.shift.amplitude, b.shift.amplitude, least_amplitude) ||
                         differ(a.shift.frequency, b.shift.frequency, least_frequency);
      if (b.point - a.point < 2 || !asked) continue;
      add(a.point + (b.point - a.point) / 2);
      --left_;
    }
    std::ranges::sort(told_, {}, &ToldShift::point);
    return told_.size() > before.size();
  }

  const Scene& scene_;
  const ResponseCurve& curve_;
  int highest_;
  const std::function<bool()>& stop_;
  std::vector<bool> asked_;
  std::vector<ToldShift> told_;
  std::size_t left_ = 0;
};

double between(double from, double to, double part) { return from + part * (to - from); }

/// @param told  in the order of the points, one at least.
std::vector<PointShift> spread(const std::vector<ToldShift>& told, std::size_t n_points) {
  std::vector<PointShift> result(n_points);
  std::size_t next = 0;
  for (std::size_t i = 0; i < n_points; ++i) {
    while (next < told.size() && told[next].point < i) ++next;
    const ToldShift& after = told[std::min(next, told.size() - 1)];
    const ToldShift& before = told[next > 0 ? next - 1 : 0];
    const double gap = static_cast<double>(after.point) - static_cast<double>(before.point);
    const double part =
        gap > 0.0 ? (static_cast<double>(i) - static_cast<double>(before.point)) / gap : 1.0;
    const double within = std::clamp(part, 0.0, 1.0);
    result[i] = {between(before.shift.frequency, after.shift.frequency, within),
                 between(before.shift.amplitude, after.shift.amplitude, within)};
  }
  return result;
}

}  // namespace

std::vector<PointShift> shifts_along(const Scene& scene, const ResponseCurve& curve, int highest,
                                     const std::function<bool()>& stop) {
  if (!scene.contact || !curve.certificate.empty()) return {};
  const Samples samples(scene, curve, highest, stop);
  if (samples.told().empty() || (stop && stop())) return {};
  return spread(samples.told(), curve.points.size());
}

}  // namespace microslip::solver
