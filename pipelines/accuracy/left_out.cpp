#include "pipelines/accuracy/left_out.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "contact/contact_force.hpp"
#include "contact/dense.hpp"
#include "contact/phase.hpp"
#include "pipelines/accuracy/limit_resonances.hpp"
#include "pipelines/accuracy/with_effect.hpp"
#include "pipelines/description/curve_request.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"
#include "solver/continuation.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {
namespace {

constexpr double not_there = std::numeric_limits<double>::infinity();

/// Of one goal, by having an effect; infinite: what it is of is lost.
struct Change {
  const char* goal;
  double effect;
  double where = 0.0;  ///< of the peak without it [rad/s]; 0: of no one peak
};
using Changes = std::vector<Change>;

const Changes not_found{{peak_amplitude_goal, not_there}, {peak_frequency_goal, not_there}};

/// The peaks of a curve, each as a curve of its own, the highest first; without one the curve,
/// whose end is the highest.
std::vector<solver::ResponseCurve> single_peaks(const solver::ResponseCurve& curve) {
  std::vector<solver::ResponseCurve> peaks;
  for (const solver::ResponsePoint& point : curve.points) {
    if (point.mark == solver::PointMark::peak) peaks.emplace_back().points = {point};
  }
  std::ranges::stable_sort(peaks, std::ranges::greater{}, [](const solver::ResponseCurve& one) {
    return one.points.front().amplitude;
  });
  if (peaks.empty()) peaks.push_back(curve);
  return peaks;
}

void keep_larger(Change& most, double effect, const solver::ResponsePoint& peak) {
  if (!(std::abs(effect) >= std::abs(most.effect))) return;
  most.effect = effect;
  most.where = peak.frequency;
}

/// The peak is looked for where it is, and where its resonance goes.
std::optional<solver::PeakOfBoth> found_elsewhere(const solver::Scene& own,
                                                  const solver::ContinuationOptions& options,
                                                  const solver::ResponseCurve& curve,
                                                  const solver::OtherModel& with) {
  if (auto both = solver::peak_elsewhere(own, options, curve, with)) return both;
  const double factor = factor_of_nearest(own, with, highest_peak(curve)->frequency);
  return solver::peak_elsewhere(own, options, curve, {with.scene, with.embedding, factor});
}

solver::PeakOfBoth pair_of(const solver::ResponsePoint& own, const solver::ResponsePoint& there) {
  return {own.frequency, own.amplitude, there.frequency, there.amplitude};
}

/// One curve of a model, and what is to be had beside it.
struct Comparison {
  const solver::Scene& own;
  const solver::OtherModel& with;
  const solver::ContinuationOptions& options;
  const solver::ResponseCurve& curve;
  double highest;  ///< amplitude [m]
  bool all_peaks;  ///< else the highest
  double seconds;  ///< of a curve with the effect, at most
};

/// Of a resonance and of the amplitude at an end of the range; of nothing, nothing has changed.
Changes at_end(double resonance, double amplitude_there) {
  if (resonance == 0.0 && amplitude_there == 0.0) return {{peak_amplitude_goal, 0.0}};
  return {{resonance_goal, resonance}, {end_amplitude_goal, amplitude_there}};
}

/// Its highest point is an end: amplitudes there say little of a resonance that lies elsewhere.
Changes without_peak(const Comparison& of, const Range& range) {
  const auto both = solver::peak_elsewhere(of.own, of.options, of.curve, of.with);
  const double change = both ? both->other_amplitude / both->amplitude - 1.0 : not_there;
  return at_end(resonance_change(of.own, of.with, range), change);
}

/// What having an effect makes of a lower peak that is not found with it.
class LostPeaks {
 public:
  explicit LostPeaks(const Comparison& of) : of_(of) {}

  /// This peak of the curve with the effect is that of another one without.
  void take(const solver::PeakOfBoth& both) { taken_.push_back(both.other_frequency); }

  /// Of a local maximum that becomes a shoulder the amplitude at its frequency tells; of one that
  /// moves far the peak of the whole curve with the effect that none of the others is nearer to;
  /// the smaller change counts, but of one that grows, whose flank may have the old height at the
  /// old frequency, its own. With neither, all that the peak has.
  std::optional<solver::PeakOfBoth> found(const solver::ResponseCurve& peak) {
    constexpr double shoulder = 0.1;  // of its amplitude
    std::optional<solver::PeakOfBoth> there =
        at_its_frequency(of_.own, of_.options, *highest_peak(peak), of_.with);
    const std::optional<solver::PeakOfBoth> moved = of_whole_curve(*highest_peak(peak));
    if (moved && moved->other_amplitude > (1.0 + shoulder) * moved->amplitude) return moved;
    if (there && change_of(*there) < shoulder * there->amplitude) return there;
    return moved && (!there || change_of(*moved) < change_of(*there)) ? moved : there;
  }

 private:
  /// [m]
  static double change_of(const solver::PeakOfBoth& both) {
    const double shift = both.other_frequency / both.frequency - 1.0;
    return std::max(std::abs(both.other_amplitude - both.amplitude),
                    std::abs(shift) * both.amplitude);
  }

  [[nodiscard]] std::optional<solver::PeakOfBoth> of_whole_curve(const solver::ResponsePoint& own) {
    if (!std::exchange(is_asked_, true)) {
      whole_ = traced_with(of_.with, of_.options, of_.curve, of_.seconds);
    }
    if (!whole_) return std::nullopt;
    const solver::ResponsePoint& other = *nearest_peak(*whole_, own.frequency);
    if (nearest_peak(of_.curve, other.frequency)->frequency != own.frequency) return std::nullopt;
    constexpr double same = 1e-4;  // of the frequency
    const auto is_other = [&](double taken) {
      return std::abs(other.frequency - taken) < same * taken;
    };
    if (std::ranges::any_of(taken_, is_other)) return std::nullopt;
    return pair_of(own, other);
  }

  const Comparison& of_;
  std::optional<solver::ResponseCurve> whole_;  // with the effect
  std::vector<double> taken_;                   // frequencies of its peaks [rad/s]
  bool is_asked_ = false;
};

/// The peaks of a curve, one after the other, with the effect.
class ComparedPeaks {
 public:
  explicit ComparedPeaks(const Comparison& of) : of_(of), lost_(of) {}

  /// @return no peak can be compared with the highest: what is told then.
  std::optional<Changes> take_highest(const solver::ResponsePoint& peak) {
    auto both = found_elsewhere(of_.own, of_.options, of_.curve, of_.with);
    if (!both && !range_.is_point()) {
      whole_ = traced_with(of_.with, of_.options, of_.curve, of_.seconds);
      if (whole_) {
        both = pair_of(peak, *highest_peak(*whole_));
        moved_ = both->other_frequency / both->frequency;
      }
    }
    if (both) {
      const double shift = both->other_frequency / both->frequency - 1.0;
      if (!range_.is_point() && !range_.has(both->other_frequency)) {
        return Changes{{peak_outside_goal, shift}};
      }
      take(*both, peak);
      return std::nullopt;
    }
    const double shift = resonance_change(of_.own, of_.with, range_);
    const bool leaves = !range_.is_point() && !range_.has((1.0 + shift) * peak.frequency);
    return leaves ? Changes{{peak_outside_goal, shift}} : not_found;
  }

  /// One that is lost changes by all it has.
  void take_lower(const solver::ResponseCurve& alone) {
    const solver::ResponsePoint& peak = *highest_peak(alone);
    auto both = whole_ ? pair_of(peak, *nearest_peak(*whole_, moved_ * peak.frequency))
                       : found_elsewhere(of_.own, of_.options, alone, of_.with);
    if (both) {
      lost_.take(*both);
    } else {
      both = lost_.found(alone);
    }
    if (both) {
      take(*both, peak);
    } else {
      keep_height(-peak.amplitude / of_.highest, peak);
    }
  }

  /// Another one, with the effect alone.
  void take_beyond() {
    const auto peak = peak_only_with(of_.own, of_.with, of_.options, of_.curve,
                                     std::max(of_.highest, highest_), of_.seconds);
    if (!peak) return;
    keep_height(peak->amplitude / of_.highest - 1.0, *peak);
    keep_larger(place_, peak->frequency / highest_peak(of_.curve)->frequency - 1.0, *peak);
  }

  /// Empty: nothing was compared.
  [[nodiscard]] Changes changes() const { return any_ ? Changes{height_, place_} : Changes{}; }

 private:
  void take(const solver::PeakOfBoth& both, const solver::ResponsePoint& peak) {
    highest_ = std::max(highest_, both.other_amplitude);
    keep_height((both.other_amplitude - both.amplitude) / of_.highest, peak);
    const double shift = both.other_frequency / both.frequency - 1.0;
    keep_larger(place_, shift * both.amplitude / of_.highest, peak);
  }

  void keep_height(double effect, const solver::ResponsePoint& peak) {
    any_ = true;
    keep_larger(height_, effect, peak);
  }

  const Comparison& of_;
  Range range_ = range_of(of_.options);
  LostPeaks lost_;
  std::optional<solver::ResponseCurve> whole_;  // with the effect, where nothing less tells
  double moved_ = 1.0;                          // frequency of the highest then
  double highest_ = 0.0;                        // of those with the effect [m]
  Change height_{peak_amplitude_goal, 0.0};
  Change place_{peak_frequency_goal, 0.0};
  bool any_ = false;
};

/// Of two maxima side by side that are one resonance the lower tells nothing of its own, and what
/// stands at its place with an effect is not its own either.
bool is_beside_higher(const std::vector<solver::ResponseCurve>& peaks, std::size_t i) {
  constexpr double beside = 5e-4;  // of the frequency
  constexpr double as_high = 0.98;
  const solver::ResponsePoint& own = *highest_peak(peaks[i]);
  return std::any_of(peaks.begin(), peaks.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const solver::ResponseCurve& other) {
                       const solver::ResponsePoint& higher = *highest_peak(other);
                       return std::abs(higher.frequency - own.frequency) < beside * own.frequency &&
                              own.amplitude > as_high * higher.amplitude;
                     });
}

Changes changes_of(const Comparison& of) {
  const Range range = range_of(of.options);
  const std::vector<solver::ResponseCurve> peaks = single_peaks(of.curve);
  const bool has_peak = peaks.front().points.front().mark == solver::PointMark::peak ||
                        range.has(highest_peak(of.curve)->frequency);
  ComparedPeaks compared(of);
  Changes told;
  if (has_peak || range.is_point()) {
    told = compared.take_highest(*highest_peak(peaks.front())).value_or(Changes{});
    if (!told.empty() && std::isinf(told.front().effect)) return told;
    for (std::size_t i = 1; i < (of.all_peaks ? peaks.size() : 1); ++i) {
      if (!is_beside_higher(peaks, i)) compared.take_lower(peaks[i]);
    }
  } else {
    told = without_peak(of, range);
  }
  compared.take_beyond();
  const Changes changes = compared.changes();
  told.insert(told.end(), changes.begin(), changes.end());
  return told;
}

/// @param model  as the curve was solved.
Changes changes_balanced(const SceneDescription& scene, const ReducedModel& model,
                         const RicherModel& other, const CurveResult& result, double load) {
  const solver::ResponsePoint& peak = *highest_peak(result.curve);
  ReducedModel richer = other.model;
  richer.effects.located = richer.effects.located || model.effects.located;
  const double factor = frequency_factor(model, richer, peak.frequency, other.embedding);
  const solver::Scene own = solver_scene(model, load);
  const solver::Scene with = solver_scene(richer, load_with(richer, model, load));
  const bool all_peaks = other.source.find(together) == std::string::npos;
  return changes_of({own,
                     {with, other.embedding, factor},
                     options_of_both(scene, model, richer),
                     result.curve,
                     peak.amplitude,
                     all_peaks,
                     seconds_of_trace(scene)});
}

/// What is integrated again: all frequencies where that is bearable, else the one where the motion
/// is largest.
SceneDescription to_integrate(const SceneDescription& scene, const CurveResult& result) {
  SceneDescription again = scene;
  if (result.curve.seconds <= bearable) return again;
  const double top_hz = highest_peak(result.curve)->frequency / (2.0 * std::numbers::pi);
  again.response->frequency_begin_hz = again.response->frequency_end_hz = top_hz;
  return again;
}

/// Of the frequency of the largest motion, beyond what one step of the sweep may hide.
double shift_beyond_a_step(const solver::ResponseCurve& curve, double from, double to) {
  const auto n = static_cast<double>(curve.points.size() - 1);
  const double step = std::abs(curve.points.back().frequency - curve.points.front().frequency) / n;
  return std::copysign(std::max(0.0, std::abs(to - from) - step), to - from) / from;
}

/// The same integration, of the model with the effect.
Changes changes_in_time(const SceneDescription& scene, const ReducedModel& model,
                        const RicherModel& other, const CurveResult& result, double load) {
  const SceneDescription again = to_integrate(scene, result);
  const bool all = again.response->frequency_begin_hz == scene.response->frequency_begin_hz &&
                   again.response->frequency_end_hz == scene.response->frequency_end_hz;
  const solver::ResponsePoint& top = *highest_peak(result.curve);
  const solver::ResponseCurve curve = integrated_elsewhere(
      other.model, again, load_with(other.model, model, load),
      all ? result.curve.points.front() : top, other.embedding, Closeness::bound);
  if (curve.diagnosis == solver::Diagnosis::interrupted) return {};
  const solver::ResponsePoint* with = highest_peak(curve);
  const char* goal = all ? peak_amplitude_goal : one_frequency_goal;
  if (with == nullptr) return {{goal, not_there}};
  Changes changes{{goal, with->amplitude / top.amplitude - 1.0}};
  if (all && result.curve.points.size() > 1) {
    changes.push_back(
        {peak_frequency_goal, shift_beyond_a_step(result.curve, top.frequency, with->frequency)});
  }
  return changes;
}

/// The linear peak, or its end.
Changes changes_of_limit(const SceneDescription& scene, const ReducedModel& model,
                         const RicherModel& other, const CurveResult& result, LimitName limit) {
  const solver::ResponsePoint& own = *highest_peak(result.curve);
  const solver::ResponseCurve curve = limit_curve(other.model, scene, limit);
  const solver::ResponsePoint* with = highest_peak(curve);
  if (with == nullptr) return not_found;
  const Range range = range_of(continuation_options(scene, model));
  const double change = with->amplitude / own.amplitude - 1.0;
  const auto is_peak = [&](const solver::ResponsePoint& point) {
    return range.is_point() || point.mark == solver::PointMark::peak;
  };
  const auto shift = [&] {
    return resonance_change(limit_scene(model), {limit_scene(other.model), other.embedding}, range,
                            limit);
  };
  if (!is_peak(own)) return at_end(shift(), change);
  if (!is_peak(*with)) return {{peak_outside_goal, shift()}};
  return {{peak_amplitude_goal, change},
          {peak_frequency_goal, with->frequency / own.frequency - 1.0}};
}

Changes changes_with(const SceneDescription& scene, const ReducedModel& model,
                     const RicherModel& other, const CurveResult& result) {
  if (const auto* limit = std::get_if<LimitName>(&result.load)) {
    return changes_of_limit(scene, model, other, result, *limit);
  }
  const double load = std::get<double>(result.load);
  try {
    return result.integrated ? changes_in_time(scene, model, other, result, load)
                             : changes_balanced(scene, model, other, result, load);
  } catch (const RefusedError&) {  // such a load cannot be with it: there is no peak
    return not_found;
  }
}

}  // namespace

std::vector<ErrorRow> rows_left_out(const ReducedModel& simulated, const SceneDescription& scene,
                                    const std::vector<RicherModel>& others,
                                    const CurveResult& result) {
  const ReducedModel model = model_of(simulated, result.curve);
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (peak == nullptr || !(peak->amplitude > 0.0)) return {};
  if (std::holds_alternative<LimitName>(result.load) && !only_limits(scene)) return {};
  std::vector<ErrorRow> rows;
  for (const RicherModel& other : others) {
    if (cut_short()) break;
    const auto begin = std::chrono::steady_clock::now();
    const Changes changes = changes_with(scene, model, other, result);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (const Change& change : changes) {
      const ErrorKind kind =
          std::isfinite(change.effect) ? ErrorKind::solved : ErrorKind::estimated;
      rows.push_back({result.name, change.goal, other.source, change.effect, kind, seconds,
                      change.where / contact::two_pi});
    }
  }
  return rows;
}

}  // namespace microslip::pipelines
