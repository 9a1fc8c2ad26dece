#include "pipelines/response/effects_of_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/effects/effect_choice.hpp"

namespace microslip::pipelines {
namespace {

bool is_limit(const CurveSummary& curve) {
  return std::holds_alternative<LimitName>(curve.preload);
}

void tell_harmonics(const SceneDescription& scene, const std::vector<CurveSummary>& curves,
                    EffectRecord& effect) {
  if (!scene.response) return;
  std::set<int> orders;
  std::size_t most = 0;
  double left_out = 0.0;
  bool is_known = true;
  for (const CurveSummary& curve : curves) {
    orders.insert(curve.harmonic_orders.begin(), curve.harmonic_orders.end());
    most = std::max(most, curve.most_harmonics);
    is_known = is_known && std::isfinite(curve.largest_left_out);
    left_out = std::max(left_out, curve.largest_left_out);
  }
  if (orders.empty()) return;
  if (!scene.settings.harmonics.chosen()) {
    const bool odd = orders.contains(3) && !orders.contains(2);
    if (odd && scene.settings.harmonics.orders.empty()) {
      effect.reason += "; even ones are zero under constant loads, and no unknowns";
    }
    return;
  }
  effect.simulated = *orders.rbegin() > 1 ? Simulated::yes : Simulated::no;
  effect.reason = fmt::format("{}: {}, of the orders {}; ", harmonics_text(scene), most,
                              fmt::join(orders, ", "));
  effect.reason +=
      is_known ? fmt::format("those left out change them by {:.2g} % at most", 100.0 * left_out)
               : "what those left out change is not known: the choice did not come to its end";
}

void tell_nonlinearity(const std::vector<CurveSummary>& curves, EffectRecord& effect) {
  const auto solved = std::ranges::count_if(
      curves, [](const CurveSummary& curve) { return !is_limit(curve) && curve.points > 0; });
  const auto proved = std::ranges::count_if(
      curves, [](const CurveSummary& curve) { return !curve.certificate.empty(); });
  if (solved == 0) return;
  effect.simulated = proved == solved ? Simulated::no : Simulated::yes;
  effect.bound.reset();
  if (proved == solved) effect.bound = 0.0;  // that is what the proofs say
  effect.reason += fmt::format("; proved linear: {} of {} curves", proved, solved);
}

void tell_solutions(const std::vector<CurveSummary>& curves, EffectRecord& effect) {
  int n_starts = 0;
  std::size_t n_found = 0;
  std::size_t n_folds = 0;
  for (const CurveSummary& curve : curves) {
    n_starts += curve.search_starts;
    n_found += curve.detached_branches;
    n_folds += curve.folds.size();
  }
  if (n_folds > 0) {
    effect.reason +=
        fmt::format("; curves have {} folds, between which solutions coexist", n_folds);
  }
  if (n_starts == 0) return;
  effect.reason += n_found > 0
                       ? fmt::format("; {} starts found {} beside the curves", n_starts, n_found)
                       : fmt::format("; {} starts found none, which proves nothing", n_starts);
}

}  // namespace

void tell_curves(const SceneDescription& scene, const std::vector<CurveSummary>& curves,
                 std::vector<EffectRecord>& effects) {
  for (EffectRecord& effect : effects) {
    if (effect.name == "higher_harmonics") tell_harmonics(scene, curves, effect);
    if (effect.name == "nonlinearity" && effect.simulated == Simulated::undecided) {
      tell_nonlinearity(curves, effect);
    }
    if (effect.name == "coexistence") tell_solutions(curves, effect);
  }
}

void tell_opening(const CurveResult& curve, std::vector<EffectRecord>& effects) {
  const auto effect = std::ranges::find(effects, "separation", &EffectRecord::name);
  if (effect == effects.end() || effect->setting != "off" || effect->simulated == Simulated::yes) {
    return;
  }
  if (!std::holds_alternative<double>(curve.load) || curve.curve.points.empty()) return;
  const auto most = std::ranges::max_element(
      curve.curve.points, {}, [](const auto& point) { return point.report.separated_share; });
  if (!(most->report.separated_share > 0.0)) {
    effect->bound = 0.0;  // the same equations
    return;
  }
  effect->bound.reset();
  effect->simulated = Simulated::yes;
  effect->objection = fmt::format(
      "contact opens all the same, on {:.2g} % of area and period of curve {} at {:.6g} Hz: curves "
      "have it, \"off\" is not obeyed",
      100.0 * most->report.separated_share, curve.name, most->frequency / (2.0 * std::numbers::pi));
}

}  // namespace microslip::pipelines
