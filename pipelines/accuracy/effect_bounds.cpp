#include "pipelines/accuracy/effect_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace microslip::pipelines {
namespace {

/// Of a highest peak: a tolerance is one of amplitudes and frequencies.
bool tells_change(const ErrorRow& row, std::string_view source) {
  return row.source == source &&
         (row.goal == peak_amplitude_goal || row.goal == peak_frequency_goal);
}

std::optional<double> largest_change(const std::vector<ErrorRow>& rows, const std::string& source) {
  std::optional<double> largest;
  for (const ErrorRow& row : rows) {
    if (!tells_change(row, source)) continue;
    largest = std::max(std::abs(row.effect), largest.value_or(0.0));
  }
  return largest;
}

std::string objection_of(double bound) {
  if (std::isinf(bound)) {
    return "left out, and with it the highest peak is not found from that without";
  }
  return fmt::format("left out, and having it changes the highest peaks by up to {:.2g} %",
                     100.0 * bound);
}

/// What a model can be solved with in place of without, settings of the scene alone apart.
constexpr std::array<std::string_view, 2> switchable{"normal_motion", "second_direction"};

/// A with / A without − 1 of a row is A without / A with − 1 of who had left it out; a peak that is
/// lost, or nearly, may be a lower one, and changes by what it has.
double change_without(double by_having) {
  constexpr double lost = -0.5;
  if (std::isinf(by_having) || by_having < lost) return std::abs(by_having);
  return std::abs(1.0 / (1.0 + by_having) - 1.0);
}

/// The largest of a source that is beyond the tolerance.
std::optional<double> missed_change(const std::vector<ErrorRow>& rows, std::string_view source,
                                    double tolerance) {
  std::optional<double> largest;
  for (const ErrorRow& row : rows) {
    if (!tells_change(row, source) || !(std::abs(row.effect) > tolerance)) continue;
    largest = std::max(change_without(row.effect), largest.value_or(0.0));
  }
  return largest;
}

std::string switched_on_text(double change) {
  if (std::isinf(change)) {
    return "switched on after the run: the highest peak with it was not found from that without";
  }
  return fmt::format(
      "switched on after the run: left out it would have changed the peak by {:.2g} %",
      100.0 * change);
}

/// Of the motion along all curves, and the curve where it is largest.
const ErrorRow* largest_indicator(const std::vector<ErrorRow>& rows, const std::string& source) {
  const ErrorRow* largest = nullptr;
  for (const ErrorRow& row : rows) {
    if (row.source != source || row.goal != std::string_view(largest_indicator_goal)) continue;
    if (largest == nullptr || row.effect > largest->effect) largest = &row;
  }
  return largest;
}

}  // namespace

void tell_bounds(const std::vector<ErrorRow>& rows, double tolerance,
                 std::vector<EffectRecord>& effects) {
  for (EffectRecord& effect : effects) {
    if (effect.simulated == Simulated::yes) continue;
    if (const ErrorRow* most = largest_indicator(rows, effect.name)) {
      effect.reason += fmt::format("; along the curves its indicator is {:.2g} at most ({})",
                                   most->effect, most->curve);
    }
    const bool harmonics = effect.name == "higher_harmonics";
    const auto change = largest_change(rows, harmonics ? "harmonics" : effect.name);
    if (!change) continue;
    effect.bound = change;
    effect.objection = *change > tolerance ? objection_of(*change) : "";
  }
}

std::vector<MissedEffect> missed_effects(const std::vector<ErrorRow>& rows, double tolerance,
                                         const std::vector<EffectRecord>& effects) {
  std::vector<MissedEffect> missed;
  for (const std::string_view name : switchable) {
    const auto effect = std::ranges::find(effects, name, &EffectRecord::name);
    if (effect == effects.end() || effect->setting != "auto") continue;
    if (effect->simulated != Simulated::no) continue;
    if (const auto change = missed_change(rows, name, tolerance)) {
      missed.push_back({std::string(name), *change});
    }
  }
  return missed;
}

void tell_switched_on(const std::vector<MissedEffect>& missed, std::vector<EffectRecord>& effects) {
  for (const MissedEffect& one : missed) {
    const auto effect = std::ranges::find(effects, one.name, &EffectRecord::name);
    if (effect == effects.end()) continue;
    effect->setting = "auto";
    effect->switched_on = one.change;
    effect->reason += "; " + switched_on_text(one.change);
  }
}

}  // namespace microslip::pipelines
