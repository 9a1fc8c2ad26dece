#include "pipelines/accuracy/effect_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/accuracy/models_left_out.hpp"
#include "pipelines/accuracy/points_to_check.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

/// Of a highest peak: a tolerance is one of amplitudes and frequencies.
bool tells_change(const ErrorRow& row, std::string_view source) {
  return row.source == source &&
         (row.goal == peak_amplitude_goal || row.goal == peak_frequency_goal);
}

/// Of a curve that has no peak to compare.
bool tells_without_peak(const ErrorRow& row, std::string_view source) {
  return row.source == source && (row.goal == resonance_goal || row.goal == end_amplitude_goal ||
                                  row.goal == peak_outside_goal || row.goal == one_frequency_goal);
}

const ErrorRow* largest_change(const std::vector<ErrorRow>& rows, std::string_view source) {
  const ErrorRow* largest = nullptr;
  for (const ErrorRow& row : rows) {
    if (!tells_change(row, source)) continue;
    if (largest == nullptr || std::abs(row.effect) > std::abs(largest->effect)) largest = &row;
  }
  return largest;
}

/// A lower peak may be the one that changes most.
std::string objection_of(const ErrorRow& change) {
  if (std::isinf(change.effect)) {
    return "left out, and with it the highest peak is not found from that without";
  }
  const std::string where =
      change.where_hz > 0.0 ? fmt::format(" at {:.4g} Hz", change.where_hz) : std::string();
  return fmt::format(
      "left out, and having it changes the peaks by up to {} of the highest of their curve ({}{})",
      percent_text(std::abs(change.effect)), change.curve, where);
}

/// Of a source and a goal, over all curves.
const ErrorRow* largest_row(const std::vector<ErrorRow>& rows, std::string_view source,
                            std::string_view goal) {
  const ErrorRow* largest = nullptr;
  for (const ErrorRow& row : rows) {
    if (row.source != source || row.goal != goal) continue;
    if (largest == nullptr || std::abs(row.effect) > std::abs(largest->effect)) largest = &row;
  }
  return largest;
}

/// The same: on how many curves it is told.
std::ptrdiff_t n_rows(const std::vector<ErrorRow>& rows, std::string_view source,
                      std::string_view goal) {
  return std::ranges::count_if(
      rows, [&](const ErrorRow& row) { return row.source == source && row.goal == goal; });
}

/// What having a source changes: the peaks that can be compared, and in words the curves that have
/// none.
struct Told {
  std::optional<double> bound{};  ///< of the peaks that can be compared
  std::vector<std::string> words{};
  double beside = 0.0;  ///< change of what the words tell that says most
  std::string most{};   ///< the words that tell it
  [[nodiscard]] bool anything() const { return bound || !words.empty(); }
};

std::string change_text(double change) {
  return std::isinf(change) ? "is not found with it"
                            : fmt::format("changes by {}{} with it", change < 0.0 ? "" : "+",
                                          percent_text(change));
}

std::string words_of(const ErrorRow& row, std::string_view goal) {
  const std::string change = change_text(row.effect);
  if (goal == resonance_goal) {
    return fmt::format(
        "curve {} has no peak within its range to compare: the resonance nearest to the range {}",
        row.curve, change);
  }
  if (goal == end_amplitude_goal) {
    return fmt::format("the amplitude at the end of the range of {} {}, which says little",
                       row.curve, change);
  }
  if (goal == peak_outside_goal) {
    return fmt::format(
        "the frequency of the peak of {} {} and lies outside the range then, its height is not "
        "compared",
        row.curve, change);
  }
  return fmt::format(
      "curve {}, of which the frequency of the largest motion alone is integrated again: its "
      "amplitude there {}",
      row.curve, change);
}

/// @param tolerance  a resonance that changes by more is told in place of the end of the range.
Told told_of(const std::vector<ErrorRow>& rows, const std::string& source, double tolerance) {
  Told told;
  if (const ErrorRow* largest = largest_change(rows, source))
    told.bound = std::abs(largest->effect);
  for (const char* goal :
       {resonance_goal, end_amplitude_goal, peak_outside_goal, one_frequency_goal}) {
    const ErrorRow* row = largest_row(rows, source, goal);
    if (row == nullptr) continue;
    told.words.push_back(words_of(*row, goal));
    const bool says_little = goal == end_amplitude_goal && told.beside > tolerance;
    if (says_little || std::abs(row->effect) < told.beside) continue;
    told.beside = std::abs(row->effect);
    told.most = told.words.back();
  }
  if (told.words.empty() || !told.bound) return told;
  told.words.push_back(
      fmt::format("peaks that can be compared change by {} at most", percent_text(*told.bound)));
  return told;
}

/// The effects of a source that has several.
std::vector<std::string_view> parts_of(std::string_view source) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= source.size();) {
    const std::size_t end = std::min(source.find(together, at), source.size());
    parts.push_back(source.substr(at, end - at));
    at = end + together.size();
  }
  return parts;
}

bool is_one_of(std::string_view source, std::string_view effect) {
  const std::vector<std::string_view> parts = parts_of(source);
  return std::ranges::find(parts, effect) != parts.end();
}

bool is_first_of(std::string_view source, std::string_view effect) {
  return source.substr(0, source.find(together)) == effect;
}

/// The source of all effects together, of which this is one; empty: there is none.
std::string joint_source(const std::vector<ErrorRow>& rows, std::string_view effect) {
  const auto row = std::ranges::find_if(rows, [&](const ErrorRow& one) {
    return one.source.find(together) != std::string::npos && is_one_of(one.source, effect);
  });
  return row == rows.end() ? "" : row->source;
}

std::string joint_text(const Told& told) {
  if (!told.words.empty()) return fmt::format("{}", fmt::join(told.words, ", "));
  if (std::isinf(*told.bound)) return "the highest peak is not found from that without";
  return "the highest peaks change by up to " + percent_text(*told.bound);
}

/// What a model can be solved with in place of without, settings of the scene alone apart.
constexpr std::array<std::string_view, 4> switchable{"normal_motion", "second_direction",
                                                     "roughness", "rate_dependence"};

/// A with / A without − 1 of a row is A without / A with − 1 of who had left it out; a peak that is
/// lost, or nearly, may be a lower one, and changes by what it has.
double change_without(double by_having) {
  constexpr double lost = -0.5;
  if (std::isinf(by_having) || by_having < lost) return std::abs(by_having);
  return std::abs(1.0 / (1.0 + by_having) - 1.0);
}

/// A tolerance is one of peaks: what moves a flank by a little more, of the highest peak, is told
/// (tell_along), and is not worth curves that take ten times as long.
constexpr double beside_peaks = 2.0;

/// The largest of a source that is beyond the tolerance.
std::optional<double> missed_change(const std::vector<ErrorRow>& rows, std::string_view source,
                                    double tolerance) {
  std::optional<double> largest;
  for (const ErrorRow& row : rows) {
    const bool there = row.source == source && row.goal == amplitude_there_goal;
    const bool told = tells_change(row, source) || tells_without_peak(row, source) || there;
    const double limit = there ? beside_peaks * tolerance : tolerance;
    if (!told || !(std::abs(row.effect) > limit)) continue;
    largest = std::max(change_without(row.effect), largest.value_or(0.0));
  }
  return largest;
}

std::string switched_on_text(double change) {
  if (std::isinf(change)) {
    return "switched on after the run: the highest peak with it was not found from that without";
  }
  return "switched on after the run: left out it would have changed the peak by " +
         percent_text(change);
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

/// The model with all of them could not be made: in words with the first of them.
void tell_none_together(const std::vector<NoBound>& none, EffectRecord& effect) {
  const auto why = std::ranges::find_if(none, [&](const NoBound& one) {
    return one.effect.find(together) != std::string::npos && is_first_of(one.effect, effect.name);
  });
  if (why == none.end()) return;
  effect.reason +=
      fmt::format("; with {} put back together no bound was made: {}", why->effect, why->why);
}

/// What having one source alone changes most, of peaks or in their place.
double change_alone(const std::vector<ErrorRow>& rows, std::string_view source) {
  double most = 0.0;
  for (const ErrorRow& row : rows) {
    const bool told = tells_change(row, source) || tells_without_peak(row, source);
    if (told) most = std::max(most, std::abs(row.effect));
  }
  return most;
}

/// Of those put back together the one that changes most alone, and so is to blame.
bool is_most_of(const std::vector<ErrorRow>& rows, std::string_view source,
                std::string_view effect) {
  const std::vector<std::string_view> parts = parts_of(source);
  const auto alone = [&](std::string_view part) { return change_alone(rows, part); };
  return *std::ranges::max_element(parts, {}, alone) == effect;
}

/// In words with the first of them, objected to with the one that matters most.
void tell_together(const std::vector<ErrorRow>& rows, double tolerance,
                   const std::vector<NoBound>& none, EffectRecord& effect) {
  const std::string source = joint_source(rows, effect.name);
  if (source.empty()) {
    tell_none_together(none, effect);
    return;
  }
  const Told told = told_of(rows, source, tolerance);
  if (!told.anything()) return;
  if (told.words.empty()) effect.bound_together = told.bound;
  const std::string text = fmt::format("with {} put back together {}", source, joint_text(told));
  if (is_first_of(source, effect.name)) effect.reason += "; " + text;
  const bool matters = told.bound.value_or(0.0) > tolerance || told.beside > tolerance;
  if (!effect.objection.empty() || !matters) return;
  if (is_most_of(rows, source, effect.name)) effect.objection = "left out, and " + text;
}

void tell_none(const std::vector<NoBound>& none, EffectRecord& effect) {
  const auto why = std::ranges::find(none, effect.name, &NoBound::effect);
  if (why == none.end()) return;
  effect.reason += fmt::format("; no bound was made of what it would change: {}", why->why);
}

/// Beside the peaks.
bool matters_there(const std::vector<ErrorRow>& rows, double tolerance, std::string_view source) {
  const ErrorRow* there = largest_row(rows, source, amplitude_there_goal);
  return there != nullptr && std::abs(there->effect) > tolerance;
}

/// Where its indicator is largest of all solution points, and what having it changes beside the
/// peaks.
void tell_along(const std::vector<ErrorRow>& rows, double tolerance, EffectRecord& effect) {
  const ErrorRow* most = largest_indicator(rows, effect.name);
  if (most == nullptr) return;
  effect.along = IndicatorAlong{most->effect, most->curve, most->where_hz};
  if (most->effect > 0.0) {
    effect.reason +=
        fmt::format("; along the curves its indicator is {:.2g} at most ({} at {:.4g} Hz)",
                    most->effect, most->curve, most->where_hz);
  }
  const ErrorRow* there = largest_row(rows, effect.name, amplitude_there_goal);
  if (there == nullptr) return;
  const std::string text = fmt::format(
      "the amplitude of {} at {:.4g} Hz, of up to {} solution points of a curve the one that seems "
      "to change most, changes by {} of the highest peak beyond what the change of the peak makes "
      "there",
      there->curve, there->where_hz, most_points_to_check, percent_text(std::abs(there->effect)));
  effect.reason += "; " + text;
  if (matters_there(rows, tolerance, effect.name)) effect.objection = "left out, and " + text;
}

}  // namespace

void tell_bounds(const std::vector<ErrorRow>& rows, double tolerance,
                 std::vector<EffectRecord>& effects, const std::vector<NoBound>& none) {
  for (EffectRecord& effect : effects) {
    tell_along(rows, tolerance, effect);
    if (effect.simulated == Simulated::yes) continue;
    const bool harmonics = effect.name == "higher_harmonics";
    const std::string source = harmonics ? "harmonics" : effect.name;
    const Told told = told_of(rows, source, tolerance);
    const ErrorRow* along = largest_row(rows, source, along_curve_goal);
    const bool of_all_curves =
        n_rows(rows, source, along_curve_goal) >= n_rows(rows, source, peak_amplitude_goal);
    if (along != nullptr && of_all_curves) effect.bound_along = along->effect;
    if (told.anything()) effect.bound = told.words.empty() ? told.bound : std::nullopt;
    for (const std::string& words : told.words) effect.reason += "; " + words;
    if (told.bound && *told.bound > tolerance) {
      effect.objection = objection_of(*largest_change(rows, source));
    }
    if (told.bound && *told.bound <= tolerance && !matters_there(rows, tolerance, effect.name)) {
      effect.objection = "";
    }
    if (told.beside > tolerance && told.beside > told.bound.value_or(0.0)) {
      effect.objection = "left out, and " + told.most;
    }
    tell_together(rows, tolerance, none, effect);
    if (!told.anything() && !effect.bound) tell_none(none, effect);
  }
}

BesideBar beside_bar(const std::vector<ErrorRow>& rows, const std::vector<std::string>& names) {
  BesideBar left_out;
  for (const std::string& name : names) {
    double largest = std::numeric_limits<double>::quiet_NaN();
    for (const ErrorRow& row : rows) {
      const bool tells = row.goal != end_amplitude_goal && tells_without_peak(row, name);
      if (tells || tells_change(row, name)) largest = std::fmax(largest, std::abs(row.effect));
    }
    left_out.emplace(name, largest);
  }
  return left_out;
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
