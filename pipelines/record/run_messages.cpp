#include "pipelines/record/run_messages.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contact/contact_force.hpp"
#include "fem/blas_threads.hpp"
#include "pipelines/accuracy/optimum_budget.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/text/effect_table.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

constexpr double to_hz = 0.5 / std::numbers::pi;

/// Of frequencies [rad/s].
struct Stretch {
  double low = 0.0;
  double high = 0.0;
};

/// Sorted, those that touch in one.
std::vector<Stretch> joined(std::vector<Stretch> stretches) {
  std::ranges::sort(stretches, {}, &Stretch::low);
  std::vector<Stretch> result;
  for (const Stretch& next : stretches) {
    if (!result.empty() && next.low <= result.back().high) {
      result.back().high = std::max(result.back().high, next.high);
    } else {
      result.push_back(next);
    }
  }
  return result;
}

/// What of `stretches` no other covers, both joined; what is shorter than a step is left out,
/// unless it is a single frequency.
std::vector<Stretch> without(const std::vector<Stretch>& stretches,
                             const std::vector<Stretch>& others) {
  constexpr double least = 1e-6;  // of the frequency: ends of neighbouring steps
  std::vector<Stretch> left;
  const auto keep = [&](double low, double high) {
    if (high - low > least * high) left.push_back({low, high});
  };
  for (const Stretch& stretch : stretches) {
    double low = stretch.low;
    for (const Stretch& other : others) {
      if (other.high < low || other.low > stretch.high) continue;
      keep(low, other.low);
      low = std::max(low, other.high);
    }
    keep(low, stretch.high);
    const auto covers = [&](const Stretch& other) {
      return other.low <= stretch.low && stretch.high <= other.high;
    };
    const bool is_point = stretch.low == stretch.high;
    if (is_point && std::ranges::none_of(others, covers)) left.push_back(stretch);
  }
  return left;
}

/// A fold is neutral: it belongs to what is beside it.
bool is_unstable(const solver::ResponsePoint& point) {
  return point.stability == solver::Stability::unstable || point.mark == solver::PointMark::fold;
}

/// One verdict is of the motion itself, the other rests on Hill's exponents, which prove nothing.
bool is_doubtful_between(const solver::ResponsePoint& a, const solver::ResponsePoint& b) {
  const auto unstable = [](const solver::ResponsePoint& point) {
    return point.stability == solver::Stability::unstable && point.mark != solver::PointMark::fold;
  };
  const auto unproved = [](const solver::ResponsePoint& point) {
    return point.stability == solver::Stability::stable &&
           point.stability_basis == solver::StabilityBasis::hill;
  };
  return (unstable(a) && unproved(b)) || (unproved(a) && unstable(b));
}

std::string text_of(const Stretch& stretch) {
  if (stretch.low == stretch.high) return fmt::format("at {:.6g}", to_hz * stretch.low);
  return fmt::format("from {:.6g} to {:.6g}", to_hz * stretch.low, to_hz * stretch.high);
}

constexpr double clearly = 1.001;  // higher

/// Than every point of the curve.
bool is_above(const solver::ResponsePoint& point, const solver::ResponseCurve& curve) {
  return std::ranges::all_of(curve.points, [&](const solver::ResponsePoint& own) {
    return point.amplitude > clearly * own.amplitude;
  });
}

/// The peak of a curve is the highest one that is marked; an end of the range may be higher. Its
/// error is not known yet, and few digits are.
std::string largest_text(const solver::ResponseCurve& curve, const solver::ResponsePoint& peak) {
  const auto highest =
      std::ranges::max_element(curve.points, {}, &solver::ResponsePoint::amplitude);
  if (!(highest->amplitude > clearly * peak.amplitude)) {
    return fmt::format("; largest {:.3g} m at {:.4g} Hz", peak.amplitude, to_hz * peak.frequency);
  }
  return fmt::format("; highest peak {:.3g} m at {:.4g} Hz, largest {:.3g} m at {:.4g} Hz",
                     peak.amplitude, to_hz * peak.frequency, highest->amplitude,
                     to_hz * highest->frequency);
}

/// "up to 9", "up to 9 and 15, which meets a mode".
std::string orders_text(const solver::RicherPeak& richer) {
  std::string text = fmt::format("up to {}", richer.highest);
  if (richer.beyond.empty()) return text;
  const char* meet = richer.beyond.size() == 1 ? "meets" : "meet";
  return text + fmt::format(" and {}, which {} a mode,", fmt::join(richer.beyond, ", "), meet);
}

}  // namespace

std::vector<std::string> modes_text(const StructureModes& modes) {
  std::vector<std::string> lines = modes.notes;
  const bool solved = modes.basis.residual.size() > 0;  // else they are given
  if (modes.timings.eigensolve > 0.0) {                 // not in an earlier run
    lines.push_back(fmt::format("BLAS: {}", fem::blas_description()));
    lines.push_back(
        fmt::format("modes: {} degrees of freedom; assembly {:.2f} s, ordering {:.2f} s, "
                    "factorisation {:.2f} s, "
                    "eigensolve {:.2f} s, inertia count {:.2f} s",
                    modes.n_dofs, modes.timings.assembly, modes.timings.ordering,
                    modes.timings.factorisation, modes.timings.eigensolve, modes.timings.inertia));
  }
  if (modes.basis.n_rigid_body > 0) {
    lines.push_back(fmt::format("{} rigid-body modes: nothing holds the structure against them",
                                modes.basis.n_rigid_body));
  }
  for (Eigen::Index i = 0; i < modes.basis.n_free(); ++i) {
    lines.push_back(
        fmt::format("mode {:2d}: {:12.4f} Hz", i + 1, to_hz * modes.basis.frequency[i]));
    if (solved) lines.back() += fmt::format("   residual {:.1e}", modes.basis.residual[i]);
  }
  if (solved && modes.basis.inertia_count < 0) {
    lines.emplace_back(
        "modes.solver = \"iterative\": modes are not counted, that none is missed is not proved");
  } else if (solved) {
    lines.push_back(fmt::format("inertia count: {} eigenvalues up to mode {}, none missed",
                                modes.basis.inertia_count, modes.basis.n_free()));
  }
  if (!modes.attachment_text.empty()) lines.push_back(modes.attachment_text);
  return lines;
}

std::string outcome_text(const CurveResult& result) {
  const solver::ResponseCurve& curve = result.curve;
  const auto* peak = highest_peak(curve);
  const std::string outcome =
      curve.complete
          ? std::string("complete")
          : fmt::format("incomplete: {}: {}", solver::to_string(curve.diagnosis), curve.message);
  return fmt::format("curve {}: {} points, {} iterations, {:.2f} s, {}{}", result.name,
                     curve.points.size(), curve.iterations, curve.seconds, outcome,
                     peak != nullptr ? largest_text(curve, *peak) : std::string());
}

bool has_higher_branch(const CurveResult& result) {
  return std::ranges::any_of(result.curve.detached, [&](const solver::DetachedBranch& branch) {
    return std::ranges::any_of(branch.points, [&](const solver::ResponsePoint& point) {
      return point.stability != solver::Stability::unstable && is_above(point, result.curve);
    });
  });
}

std::vector<std::string> detached_text(const CurveResult& result) {
  std::vector<std::string> lines;
  for (const solver::DetachedBranch& branch : result.curve.detached) {
    const auto highest =
        std::ranges::max_element(branch.points, {}, &solver::ResponsePoint::amplitude);
    if (highest == branch.points.end()) continue;
    lines.push_back(fmt::format(
        "curve {}: beside it {}; largest {:.3g} m at {:.4g} Hz{}{}", result.name,
        branch.points.size() == 1 ? "another solution"
                                  : fmt::format("a branch of {} points", branch.points.size()),
        highest->amplitude, to_hz * highest->frequency,
        highest->stability == solver::Stability::unstable ? ", unstable there" : "",
        is_above(*highest, result.curve)
            ? ", above the curve, whose peak and bar know nothing of it"
            : ""));
  }
  return lines;
}

std::string restless_text(const CurveResult& result) {
  std::vector<Stretch> settled;
  std::vector<Stretch> unstable;
  const auto add = [&](std::span<const solver::ResponsePoint> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& a = points[i];
      const auto& b = points[i + 1 < points.size() ? i + 1 : i];
      const bool both = is_unstable(a) && is_unstable(b);
      const auto [low, high] = std::minmax(a.frequency, b.frequency);
      (both || is_doubtful_between(a, b) ? unstable : settled).push_back({low, high});
    }
  };
  add(result.curve.points);
  for (const solver::DetachedBranch& branch : result.curve.detached) add(branch.points);
  const std::vector<Stretch> restless =
      without(joined(std::move(unstable)), joined(std::move(settled)));
  if (restless.empty()) return {};
  std::string where;
  for (const Stretch& stretch : restless) {
    where += (where.empty() ? "" : ", and ") + text_of(stretch);
  }
  return fmt::format(
      "curve {}: {} Hz no solution found is stable: the motion there does not repeat with the "
      "force, or is one that was not found; response.method = \"time\" shows it",
      result.name, where);
}

std::string unstable_peak_text(const CurveResult& result) {
  constexpr double nearly = 0.99;  // just beyond a fold it is the fold that is met
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (peak == nullptr || peak->stability != solver::Stability::unstable) return {};
  const solver::ResponsePoint* stable = nullptr;
  for (const solver::ResponsePoint& point : result.curve.points) {
    if (is_unstable(point)) continue;
    if (stable == nullptr || point.amplitude > stable->amplitude) stable = &point;
  }
  const bool is_told = stable == nullptr;  // by restless_text()
  if (is_told || stable->amplitude > nearly * peak->amplitude) return {};
  return fmt::format(
      "curve {}: its peak, {:.4g} m at {:.6g} Hz, is unstable: no motion stays there; what is "
      "stable reaches {:.4g} m, at {:.6g} Hz",
      result.name, peak->amplitude, to_hz * peak->frequency, stable->amplitude,
      to_hz * stable->frequency);
}

std::string rival_text(const CurveResult& result, const CurveBudget& budget) {
  constexpr double several = 3.0;  // bars: that of the other peak is not known
  constexpr double least = 1e-3;
  const solver::ResponsePoint* told = highest_peak(result.curve);
  if (told == nullptr || budget.rows.empty() || !budget.has_bar()) return {};
  const auto reach = [&](const char* goal) {
    return std::max(several * bar_of(budget.rows, result.name, goal), least);
  };
  const double lowest = (1.0 - reach(peak_amplitude_goal)) * told->amplitude;
  const double beside = reach(peak_frequency_goal) * told->frequency;
  const solver::ResponsePoint* rival = nullptr;
  for (const solver::ResponsePoint& one : result.curve.points) {
    if (one.mark != solver::PointMark::peak || one.amplitude < lowest) continue;
    if (std::abs(one.frequency - told->frequency) <= beside) continue;
    if (rival == nullptr || one.amplitude > rival->amplitude) rival = &one;
  }
  if (rival == nullptr) return {};
  return fmt::format(
      "curve {}: a second peak, {:.6g} m at {:.6g} Hz, is as high to {}: with what the settings "
      "leave out it may be the highest, and the bar is that of the one at {:.6g} Hz",
      result.name, rival->amplitude, to_hz * rival->frequency,
      percent_text(1.0 - rival->amplitude / told->amplitude), to_hz * told->frequency);
}

std::string crossing_text(const solver::Optimum& optimum) {
  const std::optional<double> other = frequency_of_crossing(optimum);
  if (!other) return {};
  return fmt::format(
      "two peaks are equally high there, at {:.6g} and {:.6g} Hz: which of both is the higher one "
      "may change with what the settings leave out",
      to_hz * optimum.best.frequency, to_hz * *other);
}

std::string many_folds_text(const CurveResult& result) {
  constexpr std::ptrdiff_t many = 20;
  const auto& points = result.curve.points;
  const std::ptrdiff_t n_folds =
      std::ranges::count(points, solver::PointMark::fold, &solver::ResponsePoint::mark);
  if (n_folds < many) return {};
  const auto n_unstable = static_cast<double>(
      std::ranges::count(points, solver::Stability::unstable, &solver::ResponsePoint::stability));
  return fmt::format(
      "curve {}: {} folds, {:.0f} % of its points unstable: many solutions share a frequency, as "
      "where light damping, or friction that falls with the speed, lets higher harmonics resonate; "
      "more damping or fewer response.harmonics have fewer of them, response.method = \"time\" "
      "over a narrow range shows what a sweep meets",
      result.name, n_folds, 100.0 * n_unstable / static_cast<double>(points.size()));
}

std::string left_out_text(const CurveResult& result) {
  if (!result.richer || result.curve.points.empty()) return {};
  const solver::RicherPeak& richer = *result.richer;
  const int given = result.curve.points.front().q.n_harmonics();
  const std::string more = orders_text(richer);
  // A list may have those that resonate and no others in between.
  const std::string remedy =
      richer.beyond.empty() ? fmt::format("response.harmonics = {} or \"auto\"", richer.highest)
                            : "response.harmonics = \"auto\"";
  if (!richer.change) {
    return fmt::format(
        "curve {}: with harmonics {} its peak is not found from the one with {}: these do not tell "
        "this curve; set {}",
        result.name, more, given, remedy);
  }
  if (!(std::abs(*richer.change) >= worth_a_warning)) return {};  // nor of what does not move
  return fmt::format(
      "curve {}: with harmonics {} its peak is {:.3g} m at {:.4g} Hz: harmonics up to {} put it "
      "{:.0f} % too {}; set {}",
      result.name, more, richer.amplitude, to_hz * richer.frequency, given,
      100.0 * std::abs(*richer.change), *richer.change > 0.0 ? "low" : "high", remedy);
}

std::string precision_text(const CurveSummary& curve, const ReducedModel& model) {
  // Forces sampled in time balance as far as they are solved for; the work of slip is that of the
  // samples.
  const bool sampled = contact::is_sampled(model.patches, model.effects);
  const double certified = sampled ? 1e-6 : 1e-10;
  const double mismatch = is_rough(model) || sampled ? 0.0 : curve.largest_dissipation_mismatch;
  const bool all_are = curve.largest_residual <= certified &&
                       curve.largest_energy_imbalance <= certified && mismatch <= certified;
  if (all_are) return {};  // none is NaN either
  return fmt::format(
      "precision: curve {}: {} leaves a residual of {:.1e}, an energy imbalance of {:.1e} and a "
      "dissipation mismatch of {:.1e} ({:.0e} is customary): forces nearly cancel, or little work "
      "is done",
      curve.name, sampled ? "sampling" : "rounding", curve.largest_residual,
      curve.largest_energy_imbalance, curve.largest_dissipation_mismatch, certified);
}

std::string best_text(const solver::Optimum& optimum, const std::string& unit,
                      const CurveBudget& budget) {
  if (!optimum.found) {
    return fmt::format("not found: {}{}", optimum.message, lowest_text(optimum));
  }
  if (!budget.has_bar() || optimum.best.place != solver::PeakPlace::peak) {
    return fmt::format("{:.3g}{}, {}; how wrong that is is not known", optimum.best.parameter, unit,
                       amplitude_text(optimum.best));
  }
  const auto rounded = [&](double value, const char* goal) {
    return with_half_width(value, bar_of(budget.rows, optimum_name, goal));
  };
  std::string text =
      fmt::format("{}{}, peak {} m at {} Hz", rounded(optimum.best.parameter, optimum_goal), unit,
                  rounded(optimum.best.amplitude, peak_amplitude_goal),
                  rounded(to_hz * optimum.best.frequency, peak_frequency_goal));
  if (!budget.energy_ratio) return text + ", where friction dissipates nothing";
  return fmt::format("{}, dissipating {} J in a period", text,
                     rounded(budget.dissipated_energy, dissipated_energy_goal));
}

std::string few_harmonics_text(const OptimumBracket& bracket) {
  if (bracket.entries.empty() || bracket.entries.front().n_harmonics == 0) return {};
  const OptimumOfFactor& first = bracket.entries.front();
  const bool has_own = first.factor == 1.0;
  return fmt::format(
      "how the best value moves is searched with {} harmonics: compare with {}, not with the best "
      "value above",
      first.n_harmonics, has_own ? first.parameter + " x 1" : "one another");
}

std::string bracket_text(const OptimumOfFactor& entry, const CurveBudget& budget) {
  const solver::Optimum& optimum = entry.optimum;
  if (!optimum.found) {
    return fmt::format("not found: {}{}", optimum.objection, lowest_text(optimum));
  }
  const solver::PeakOfParameter& best = optimum.best;
  if (!budget.has_bar() || best.place != solver::PeakPlace::peak) {
    return fmt::format("best {:.3g}, {}", best.parameter, amplitude_text(best));
  }
  const auto rounded = [&](double value, const char* goal) {
    return with_digits_of(value, bar_of(budget.rows, optimum_name, goal));
  };
  return fmt::format("best {}, peak {} m at {} Hz", rounded(best.parameter, optimum_goal),
                     rounded(best.amplitude, peak_amplitude_goal),
                     rounded(to_hz * best.frequency, peak_frequency_goal));
}

std::string amplitude_text(const solver::PeakOfParameter& best) {
  const double frequency_hz = to_hz * best.frequency;
  switch (best.place) {
    case solver::PeakPlace::peak:
      return fmt::format("peak {:.3g} m at {:.4g} Hz", best.amplitude, frequency_hz);
    case solver::PeakPlace::range_end:
      return fmt::format("largest amplitude {:.3g} m at {:.4g} Hz, the end of the frequency range",
                         best.amplitude, frequency_hz);
    case solver::PeakPlace::unsolved:
      break;
  }
  return fmt::format("amplitude at least {:.3g} m, at {:.4g} Hz", best.amplitude, frequency_hz);
}

std::string lowest_text(const solver::Optimum& optimum) {
  return optimum.trace.empty() ? "" : "; " + amplitude_text(optimum.best);
}

std::string range_text(const OptimumOfFactor& entry) {
  return entry.widened ? fmt::format(
                             " (searched from {:.6g} to {:.6g}, wider than the range as given: the "
                             "best preload "
                             "moves with 1/friction)",
                             entry.range[0], entry.range[1])
                       : "";
}

}  // namespace microslip::pipelines
