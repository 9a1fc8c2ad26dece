#include "pipelines/accuracy/optimum_budget.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/in_parallel.hpp"
#include "pipelines/system/interrupt.hpp"

namespace microslip::pipelines {
namespace {

constexpr std::size_t n_about = 3;
constexpr std::size_t middle = 1;
using Effects = std::array<std::optional<double>, n_about>;  // at each of them

/// Amplitudes over the number searched, between the values that the search has solved for.
class Peaks {
 public:
  explicit Peaks(const std::vector<solver::PeakOfParameter>& trace) : trace_(trace) {}

  [[nodiscard]] double at(double value) const {
    const auto after =
        std::ranges::lower_bound(trace_, value, {}, &solver::PeakOfParameter::parameter);
    if (after == trace_.end()) return trace_.back().amplitude;
    if (after == trace_.begin() || after->parameter == value) return after->amplitude;
    const auto before = after - 1;
    const double share =
        std::log(value / before->parameter) / std::log(after->parameter / before->parameter);
    return std::pow(before->amplitude, 1.0 - share) * std::pow(after->amplitude, share);
  }

 private:
  const std::vector<solver::PeakOfParameter>& trace_;  // by parameter
};

using Values = PeaksAboutBest;

/// A branch that a sweep does not meet begins or ends at the best value: on one side of it the
/// nearest curve that was traced whole has its highest peak on such a branch.
bool is_beside_detached(const solver::Optimum& optimum) {
  const auto is_told = [](const solver::PeakOfParameter& one) { return one.whole_curve; };
  const auto& trace = optimum.trace;
  const auto best =
      std::ranges::find(trace, optimum.best.parameter, &solver::PeakOfParameter::parameter);
  if (best == trace.end()) return false;
  const auto after = std::find_if(best + 1, trace.end(), is_told);
  const auto before = std::find_if(std::make_reverse_iterator(best), trace.rend(), is_told);
  return (after != trace.end() && after->detached) || (before != trace.rend() && before->detached);
}

/// The search has followed the peaks of these curves. Beside the best value a curve may be higher
/// than what was followed there, not as high as where a peak has jumped: that says nothing of its
/// place.
bool are_those_followed(const ValuesAboutBest& values, const Values& amplitudes,
                        const solver::Optimum& optimum) {
  constexpr double same = 0.01;   // at the best value itself
  constexpr double nearly = 0.1;  // between values that were solved for
  constexpr double jumped = 2.0;  // times the lowest
  const Peaks followed(optimum.trace);
  if (is_beside_detached(optimum)) return false;
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    const double change = amplitudes[i] / followed.at(values[i]) - 1.0;
    const bool is_same = i == middle ? std::abs(change) < same : change > -nearly;
    if (!is_same || !(amplitudes[i] < jumped * amplitudes[middle])) return false;
  }
  return true;
}

/// log A over log p: the line that falls to the best value and the one that rises from it, each
/// raised by an effect of its own.
struct TwoSides {
  double falls, rises;               ///< slopes
  double raised_left, raised_right;  ///< log(1 + e)
  double lowest, highest;            ///< log of the neighbours over the best value

  TwoSides(const ValuesAboutBest& values, const Values& amplitudes, const Values& effect)
      : falls(slope_to(values, amplitudes, 0)),
        rises(slope_to(values, amplitudes, n_about - 1)),
        raised_left(std::log1p(std::max(effect.front(), -0.99))),
        raised_right(std::log1p(std::max(effect.back(), -0.99))),
        lowest(std::log(values.front() / values[middle])),
        highest(std::log(values.back() / values[middle])) {}

  [[nodiscard]] double turn() const { return rises - falls; }

 private:
  static double slope_to(const ValuesAboutBest& values, const Values& amplitudes, std::size_t i) {
    return std::log(amplitudes[i] / amplitudes[middle]) / std::log(values[i] / values[middle]);
  }
};

/// Where the lowest peak goes, over the best value, less 1.
double shift(const TwoSides& sides) {
  if (!(sides.turn() > 0.0)) return std::expm1(sides.highest);
  const double way = (sides.raised_left - sides.raised_right) / sides.turn();
  return std::expm1(std::clamp(way, sides.lowest, sides.highest));
}

/// What both peaks are where they cross, over what they were, less 1.
double crossing_changed(const TwoSides& sides) {
  if (!(sides.turn() > 0.0)) return 0.0;
  return std::expm1((sides.rises * sides.raised_left - sides.falls * sides.raised_right) /
                    sides.turn());
}

/// Of the lowest peak, which is that of a neighbour where the effect there makes it so.
double lowest_changed(const Values& amplitudes, const Values& effect) {
  Values raised = amplitudes;
  for (std::size_t i = 0; i < raised.size(); ++i) raised[i] *= 1.0 + std::max(effect[i], -0.99);
  return std::ranges::min(raised) / amplitudes[middle] - 1.0;
}

double further(double a, double b) { return std::abs(a) > std::abs(b) ? a : b; }

/// Of one goal by source.
std::map<std::string, Effects> by_source(const std::vector<CurveBudget>& budgets,
                                         const char* goal) {
  std::map<std::string, Effects> effects;
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    for (const ErrorRow& row : budgets[i].rows) {
      if (row.goal == goal) effects[row.source][i] = row.effect;
    }
  }
  return effects;
}

/// One that is missing is taken from beside it, from the larger of both. @return empty: more are
/// missing.
std::optional<Values> all_known(const Effects& effects) {
  const auto is_known = [](const std::optional<double>& one) { return one.has_value(); };
  if (std::ranges::count_if(effects, is_known) < 2) return std::nullopt;
  const auto larger_beside = [&] {
    return std::abs(*effects.front()) > std::abs(*effects.back()) ? *effects.front()
                                                                  : *effects.back();
  };
  const double centre = effects[middle] ? *effects[middle] : larger_beside();
  return std::array{effects.front().value_or(centre), centre, effects.back().value_or(centre)};
}

double seconds_of(const std::vector<CurveBudget>& budgets, const std::string& source) {
  double seconds = 0.0;
  for (const CurveBudget& budget : budgets) {
    for (const ErrorRow& row : budget.rows) {
      if (row.source == source && row.goal == peak_amplitude_goal) seconds += row.seconds;
    }
  }
  return seconds;
}

/// Those of the search, where they are chosen: what they lack is a row of its own. Nobody reads
/// whether motions are stable.
SceneDescription with_harmonics_of(SceneDescription scene, const solver::Optimum& optimum) {
  scene.judges_stability = false;
  if (!scene.settings.harmonics.chosen() || optimum.orders.empty()) return scene;
  scene.settings.harmonics = {.highest = std::ranges::max(optimum.orders),
                              .orders = optimum.orders};
  return scene;
}

}  // namespace

std::optional<double> frequency_of_crossing(const solver::Optimum& optimum) {
  constexpr double near_by = 0.02;  // of the parameter, and of the amplitude
  constexpr double jump = 0.01;     // of the frequency: one peak moves less
  const solver::PeakOfParameter& best = optimum.best;
  for (const solver::PeakOfParameter& one : optimum.trace) {
    const bool is_near =
        std::abs(one.parameter - best.parameter) <= near_by * std::abs(best.parameter) &&
        std::abs(one.amplitude - best.amplitude) <= near_by * best.amplitude;
    const bool is_other = std::abs(one.frequency - best.frequency) > jump * best.frequency;
    if (is_near && is_other) return one.frequency;
  }
  return std::nullopt;
}

std::optional<ValuesAboutBest> values_about(double best,
                                            const std::optional<std::array<double, 2>>& range) {
  constexpr double closest = 1e-3;  // relative: nearer ones tell rounding, not a slope
  if (!(best > 0.0)) return std::nullopt;
  ValuesAboutBest values{0.84 * best, best, 1.19 * best};
  if (range) {
    values.front() = std::max(values.front(), (*range)[0]);
    values.back() = std::min(values.back(), (*range)[1]);
  }
  const bool has_sides = values.front() > 0.0 && best - values.front() > closest * best &&
                         values.back() - best > closest * best;
  return has_sides ? std::optional(values) : std::nullopt;
}

CurveBudget budget_about_best(const std::vector<CurveBudget>& budgets,
                              const ValuesAboutBest& values, const PeaksAboutBest& amplitudes_given,
                              std::optional<double> jump) {
  const std::map<std::string, Effects> frequencies = by_source(budgets, peak_frequency_goal);
  const std::map<std::string, Effects> energies = by_source(budgets, dissipated_energy_goal);
  CurveBudget result;
  result.dissipated_energy = budgets[middle].dissipated_energy;
  result.energy_ratio = budgets[middle].energy_ratio;
  std::set<std::string> unknown;
  const std::map<std::string, Effects> amplitudes = by_source(budgets, peak_amplitude_goal);
  for (const CurveBudget& budget : budgets) {
    for (const std::string& source : budget.unknown) {
      if (!amplitudes.contains(source)) unknown.insert(source);
    }
  }
  for (const auto& of_source : amplitudes) {
    const std::string& source = of_source.first;
    const auto known = all_known(of_source.second);
    if (!known) {
      unknown.insert(source);
      continue;
    }
    const double seconds = seconds_of(budgets, source);
    const auto add = [&](const char* goal, double effect) {
      result.rows.push_back({optimum_name, goal, source, effect, ErrorKind::solved, seconds});
    };
    const TwoSides sides(values, amplitudes_given, *known);
    add(optimum_goal, shift(sides));
    const double lowest = lowest_changed(amplitudes_given, *known);
    add(peak_amplitude_goal, jump ? further(crossing_changed(sides), lowest) : lowest);
    const auto of_frequency = all_known(frequencies.at(source));
    add(peak_frequency_goal, of_frequency ? (*of_frequency)[middle] : 0.0);
    if (!result.energy_ratio) continue;
    const auto of_energy = energies.find(source);
    add(dissipated_energy_goal, of_energy != energies.end() && of_energy->second[middle]
                                    ? *of_energy->second[middle]
                                    : *result.energy_ratio * (*known)[middle]);
  }
  if (jump && !result.rows.empty()) {
    result.rows.push_back({optimum_name, peak_frequency_goal, "continuation", *jump});
  }
  result.unknown = {unknown.begin(), unknown.end()};
  return result;
}

CurveBudget optimum_budget(const ScenesAboutBest& about, const solver::Optimum& optimum, int jobs) {
  if (!optimum.found) return {};
  std::vector<CurveBudget> budgets(n_about);
  Values amplitudes{};
  const auto is_over = [] { return interrupt_requested() || cut_short(); };
  const auto goes_on = [&](const solver::ResponsePoint&) { return !is_over(); };
  in_parallel(n_about, jobs, [&](std::size_t i) {
    if (is_over()) return;
    const SceneDescription searched = with_harmonics_of(*about[i].scene, optimum);
    const CurveRequest request{optimum_name, about[i].load};
    const CurveResult curve =
        i == middle && optimum.best_curve
            ? checked_curve(*about[i].model, searched, request, *optimum.best_curve)
            : trace_curve(*about[i].model, searched, request, goes_on);
    budgets[i] = error_budget(*about[i].model, searched, *about[i].richer, curve);
    const solver::ResponsePoint* peak = highest_peak(curve.curve);
    if (peak != nullptr) amplitudes[i] = peak->amplitude;
  });
  if (is_over()) return {};
  const ValuesAboutBest values{about[0].value, about[1].value, about[2].value};
  if (!are_those_followed(values, amplitudes, optimum)) return {};
  const std::optional<double> other = frequency_of_crossing(optimum);
  return budget_about_best(
      budgets, values, amplitudes,
      other ? std::optional(*other / optimum.best.frequency - 1.0) : std::nullopt);
}

CurveBudget optimum_budget(const ReducedModel& model, const SceneDescription& scene,
                           const RicherModels& richer, const solver::Optimum& optimum, int jobs) {
  const auto values = values_about(optimum.best.parameter);
  if (!optimum.found || !values) return {};
  ScenesAboutBest about{};
  for (std::size_t i = 0; i < n_about; ++i) {
    about[i] = {(*values)[i], (*values)[i], &scene, &model, &richer};
  }
  return optimum_budget(about, optimum, jobs);
}

}  // namespace microslip::pipelines
