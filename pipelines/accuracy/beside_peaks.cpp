#include "pipelines/accuracy/beside_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "contact/phase.hpp"
#include "pipelines/accuracy/points_to_check.hpp"
#include "pipelines/accuracy/with_effect.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/text/effect_table.hpp"
#include "solver/point_shift.hpp"

namespace microslip::pipelines {
namespace {

/// Of a source and a goal; none: not told.
const ErrorRow* row_of(const std::vector<ErrorRow>& rows, const std::string& source,
                       std::string_view goal) {
  const auto row = std::ranges::find_if(
      rows, [&](const ErrorRow& one) { return one.source == source && one.goal == goal; });
  return row == rows.end() ? nullptr : &*row;
}

/// What the highest peak of a curve does by having an effect, relative.
struct PeakChange {
  const solver::ResponsePoint& peak;
  double height, shift;

  /// What that makes of an amplitude [m]: as much higher, and shifted. @param point  with a slope.
  [[nodiscard]] double made_at(const solver::ResponsePoint& point) const {
    return std::abs(height) * point.amplitude +
           std::abs(point.slope->amplitude * shift) * peak.frequency;
  }
  /// Of a change of amplitude, over the peak.
  [[nodiscard]] double beyond(double change, const solver::ResponsePoint& point) const {
    const double more = std::max(0.0, std::abs(change) - made_at(point));
    return std::copysign(more, change) / peak.amplitude;
  }
};

/// The model with an effect, at the frequencies of points without.
class SolvedThere {
 public:
  /// @param other  borrowed.
  SolvedThere(const SceneDescription& scene, const ReducedModel& model, const RicherModel& other,
              double load)
      : own_(solver_scene(model, load)),
        richer_(solver_scene(richer_of(model, other), load_with(other.model, model, load))),
        embedding_(other.embedding),
        options_(options_of_both(scene, model, richer_of(model, other))) {}

  /// Change of the amplitude by having it, to first order [m]; infinite: not told.
  [[nodiscard]] double estimate(const solver::ResponsePoint& point) const {
    const auto shift = solver::amplitude_shift(richer_, options_, point);
    return shift ? *shift * point.amplitude : std::numeric_limits<double>::infinity();
  }
  /// Such a step is between the same modes.
  [[nodiscard]] bool has_own_modes() const { return embedding_.size() > 0; }
  /// The same, solved for; none: no solution near by.
  std::optional<double> change(const solver::ResponsePoint& point) {
    const auto both = at_its_frequency(own_, options_, point, {richer_, embedding_});
    if (!both) return std::nullopt;
    return both->other_amplitude - both->amplitude;
  }

 private:
  static ReducedModel richer_of(const ReducedModel& model, const RicherModel& other) {
    ReducedModel richer = other.model;
    richer.effects.located = richer.effects.located || model.effects.located;
    richer.effects.doublings = model.effects.doublings;  // a flank asks for less than a peak
    return richer;
  }

  solver::Scene own_;
  solver::Scene richer_;
  const Eigen::MatrixXd& embedding_;
  solver::ContinuationOptions options_;
};

/// The first of the places is solved for. Of the others one step in the model with the effect tells
/// which changes most, and that is solved for, or the next where it has no solution near by: a
/// step is short where the effect adds stiffness.
std::vector<ErrorRow> solved_places(const CurveResult& result, const std::string& source,
                                    const std::vector<std::size_t>& places, const PeakChange& peak,
                                    SolvedThere& there) {
  std::vector<ErrorRow> rows;
  const auto solve = [&](const solver::ResponsePoint& point) {
    const auto change = there.change(point);
    if (!change) return false;
    rows.push_back({result.name, amplitude_there_goal, source, peak.beyond(*change, point),
                    ErrorKind::solved, 0.0, point.frequency / contact::two_pi});
    return true;
  };
  struct Place {
    double estimate;
    const solver::ResponsePoint* point;
  };
  std::vector<Place> others;
  for (const std::size_t place : places) {
    if (cut_short()) return rows;
    const solver::ResponsePoint& point = result.curve.points[place];
    if (place == places.front()) {
      solve(point);
    } else {
      const double estimate = std::abs(peak.beyond(there.estimate(point), point));
      others.push_back({std::isfinite(estimate) ? estimate : 0.0, &point});
    }
  }
  std::ranges::stable_sort(others, std::ranges::greater{}, &Place::estimate);
  for (const Place& place : others) {
    if (cut_short() || solve(*place.point)) break;
  }
  return rows;
}

/// Peaks are solved for anyway, and at folds a curve has no slope.
bool can_be_checked(const solver::ResponsePoint& point) {
  return point.slope && point.mark == solver::PointMark::none;
}

constexpr std::size_t n_spread = 8;

/// Of a curve with more unknowns a sample takes as long as the curve: 80 s of processor beside 93
/// of the default blade with up to 19 harmonics, where it says nothing that is acted upon.
bool is_worth_a_sample(const solver::ResponseCurve& curve) {
  constexpr Eigen::Index most_unknowns = 300;
  const solver::ResponsePoint& point = curve.points.front();
  const Eigen::Index n_orders =
      point.orders.empty() ? point.q.n_harmonics() : static_cast<Eigen::Index>(point.orders.size());
  return (2 * n_orders + 1) * point.q.rows().cols() <= most_unknowns;
}

/// So many, or all that a curve has.
std::vector<std::size_t> spread_points(const std::vector<solver::ResponsePoint>& points) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (can_be_checked(points[i])) all.push_back(i);
  }
  if (all.size() <= n_spread) return all;
  std::vector<std::size_t> spread;
  for (std::size_t k = 0; k < n_spread; ++k) {
    spread.push_back(all[k * (all.size() - 1) / (n_spread - 1)]);
  }
  return spread;
}

/// Where an amplitude at its frequency changes most, of points that are tried.
class LargestChange {
 public:
  /// @param there  borrowed.
  LargestChange(const std::vector<solver::ResponsePoint>& points, SolvedThere& there)
      : points_(points), there_(there) {}

  /// @return false: the model with the effect has no solution near by.
  bool solve(std::size_t i) {
    const auto known = tried_.find(i);
    if (known != tried_.end()) return known->second;
    const auto change = there_.change(points_[i]);
    tried_.emplace(i, change.has_value());
    if (change && std::abs(*change) > change_) {
      change_ = std::abs(*change);
      at_ = i;
    }
    return change.has_value();
  }
  /// Points on both sides of the best, nearer and nearer.
  void look_around(std::size_t step) {
    for (; step > 0 && change_ > 0.0 && !cut_short(); step /= 2) {
      for (const std::size_t i : {at_ + step, at_ - step}) {  // below 0 is far beyond the last
        if (i < points_.size() && can_be_checked(points_[i])) solve(i);
      }
    }
  }
  [[nodiscard]] double change() const { return change_; }  ///< [m]
  [[nodiscard]] const solver::ResponsePoint& where() const { return points_[at_]; }

 private:
  const std::vector<solver::ResponsePoint>& points_;
  SolvedThere& there_;
  std::map<std::size_t, bool> tried_;  // whether there was a solution
  double change_ = 0.0;
  std::size_t at_ = 0;
};

/// What a user sees who lays both curves over one another: of points spread over the curve, and of
/// those where the indicator calls for the effect, the few that seem to change most are solved for,
/// and what lies beside the best of them.
ErrorRow along_row(const CurveResult& result, const std::string& source,
                   std::vector<std::size_t> places, const PeakChange& peak, SolvedThere& there) {
  constexpr int n_solved = 2;
  const std::vector<solver::ResponsePoint>& points = result.curve.points;
  std::ranges::copy(spread_points(points), std::back_inserter(places));
  const auto seems = [&](std::size_t i) {
    const double change =
        there.has_own_modes() ? peak.made_at(points[i]) : std::abs(there.estimate(points[i]));
    return std::isfinite(change) ? change : 0.0;
  };
  std::vector<std::pair<double, std::size_t>> ranked;
  for (const std::size_t i : places) {
    if (!cut_short()) ranked.emplace_back(seems(i), i);
  }
  std::ranges::sort(ranked, std::ranges::greater{});
  LargestChange largest(points, there);
  int n = 0;
  for (const auto& [estimate, i] : ranked) {
    if (n == n_solved || cut_short()) break;
    if (largest.solve(i)) ++n;
  }
  largest.look_around(points.size() / (2 * n_spread));
  const bool beside = largest.change() > std::abs(peak.height) * peak.peak.amplitude;
  const double change = beside ? largest.change() / peak.peak.amplitude : std::abs(peak.height);
  const solver::ResponsePoint& where = beside ? largest.where() : peak.peak;
  return {result.name,
          along_curve_goal,
          source,
          change,
          ErrorKind::solved,
          0.0,
          where.frequency / contact::two_pi};
}

}  // namespace

std::vector<ErrorRow> rows_there(const ReducedModel& simulated, const SceneDescription& scene,
                                 const std::vector<RicherModel>& others, const CurveResult& result,
                                 const std::vector<IndicatorOfCurve>& along,
                                 const std::vector<ErrorRow>& known) {
  const auto* load = std::get_if<double>(&result.load);
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (load == nullptr || result.integrated || peak == nullptr) return {};
  const ReducedModel model = model_of(simulated, result.curve);
  std::vector<ErrorRow> rows;
  for (const RicherModel& other : others) {
    if (other.source.find(together) != std::string::npos) continue;
    const auto indicator = std::ranges::find(along, other.source, &IndicatorOfCurve::effect);
    const ErrorRow* height = row_of(known, other.source, peak_amplitude_goal);
    const ErrorRow* shift = row_of(known, other.source, peak_frequency_goal);
    if (const ErrorRow* outside = row_of(known, other.source, peak_outside_goal)) {
      shift = outside;
      height = nullptr;  // of lower peaks
    }
    if (shift == nullptr) continue;
    const double higher = height != nullptr ? height->effect : 0.0;  // of one outside: not compared
    if (!std::isfinite(higher)) continue;
    const PeakChange change{*peak, higher, shift->effect};
    std::vector<std::size_t> places;
    if (indicator != along.end()) {
      places = points_to_check(result.curve, indicator->at, effect_row(other.source).threshold);
    }
    SolvedThere there(scene, model, other, *load);
    if (!places.empty()) {
      for (const ErrorRow& row : solved_places(result, other.source, places, change, there)) {
        rows.push_back(row);
      }
    }
    if (height != nullptr && is_worth_a_sample(result.curve)) {
      rows.push_back(along_row(result, other.source, std::move(places), change, there));
    }
  }
  return rows;
}

}  // namespace microslip::pipelines
