#include "pipelines/stages/curve_family.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contact/contact_force.hpp"
#include "pipelines/accuracy/along_curve.hpp"
#include "pipelines/accuracy/amplitude_band.hpp"
#include "pipelines/accuracy/beside_peaks.hpp"
#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/accuracy/left_out.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/response/curve_maps.hpp"
#include "pipelines/response/harmonics_check.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/stages/kept_results.hpp"
#include "pipelines/stages/shared_curves.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/in_parallel.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/result_cache.hpp"

namespace microslip::pipelines {
namespace {

/// Done of a family of curves, 0 … 1: a point tells how far its own has come through the range; a
/// turn back lowers it.
double fraction_of(const SceneDescription& scene, const solver::ResponsePoint& point,
                   std::size_t n_done, std::size_t n_curves) {
  const ResponseDescription& range = *scene.response;
  const double width = range.frequency_end_hz - range.frequency_begin_hz;
  const double frequency_hz = point.frequency / (2.0 * std::numbers::pi);
  const double share = width == 0.0 ? 1.0 : (frequency_hz - range.frequency_begin_hz) / width;
  return (static_cast<double>(n_done) + std::clamp(share, 0.0, 1.0)) /
         static_cast<double>(n_curves);
}

bool goes_on() { return !interrupt_requested() && !cut_short(); }

void stop_if_interrupted(const std::string& kept) {
  if (!interrupt_requested()) return;
  throw InterruptedError("interrupted; finished " + kept +
                         " are kept: the same command with --resume goes on");
}

/// In which order curves are solved: with a budget the cheap ones first, linear limits and high
/// preloads, so that there are as many as can be when it is over.
std::vector<std::size_t> order_of(const ReducedModel& model,
                                  const std::vector<CurveRequest>& requests, double budget) {
  std::vector<std::size_t> order(requests.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::isfinite(budget)) return order;
  const auto price = [&](std::size_t i) {
    if (!is_loaded(requests[i])) return -std::numeric_limits<double>::infinity();
    const auto* gap = std::get_if<UniformGap>(&requests[i].load);
    return gap != nullptr ? gap->width * total_normal_stiffness(model)
                          : -std::get<double>(load_of(requests[i], model));
  };
  std::ranges::stable_sort(order, {}, price);
  return order;
}

/// Curves under a load that are not begun before a place in the order; linear limits take no time.
std::size_t n_loaded(const std::vector<CurveRequest>& requests,
                     const std::vector<std::size_t>& order, std::size_t place) {
  return static_cast<std::size_t>(
      std::count_if(order.begin() + static_cast<std::ptrdiff_t>(place), order.end(),
                    [&](std::size_t i) { return is_loaded(requests[i]); }));
}

void tell_shares(const std::vector<int>& solved, Progress& progress) {
  if (solved.size() == 1) return;
  progress.info(fmt::format("curves solved on each MPI rank: {}", fmt::join(solved, ", ")));
}

/// Whether a curve is what it would be with more time.
class TimeOfCurve {
 public:
  /// Begins with the curve. @param model, scene  borrowed.
  TimeOfCurve(const ReducedModel& model, const SceneDescription& scene)
      : model_(model),
        scene_(scene),
        limit_(scene.response->time_budget),
        of_check_(share_of_check * scene.accuracy.budget) {}

  /// Else it may be cut short, or have fewer harmonics than it was to have.
  [[nodiscard]] bool was_enough(const CurveResult& curve) const {
    const bool lacks_time = curve.lacks_time || curve.curve.diagnosis == solver::Diagnosis::budget;
    return !interrupt_requested() && !time_is_short() && !lacks_time;
  }
  /// Else it may lack a check of its harmonics, or other solutions beside it, as well.
  [[nodiscard]] bool changes_nothing(const CurveResult& curve) const {
    const bool unchecked = of_check_.is_over() && !curve.richer &&
                           curve.curve.certificate.empty() &&
                           harmonics_to_check(model_, scene_) > 0;
    return was_enough(curve) && !limit_.is_over() && !unchecked;
  }

 private:
  const ReducedModel& model_;
  const SceneDescription& scene_;
  TimeLimit limit_;
  TimeLimit of_check_;
};

}  // namespace

std::vector<CurveResult> trace_family(const ReducedModel& model, const SceneDescription& scene,
                                      int jobs, RunRecord& record) {
  const std::vector<CurveRequest> requests = curve_requests(scene);
  if (requests.empty()) return {};
  const KeptResults kept_results(model, scene);
  std::vector<CurveResult> results(requests.size());
  const std::vector<std::size_t> order = order_of(model, requests, scene.accuracy.budget);
  std::mutex keeping;
  std::vector<bool> finished(requests.size(), false);
  std::size_t kept = 0;
  std::atomic<std::size_t> done{0};
  const auto trace = [&](std::size_t place, const CurveSolver& solve) {
    const std::size_t i = order[place];
    stop_if_interrupted("points");
    const auto observe = [&](const solver::ResponsePoint& point) {
      record.note_point(requests[i].name, load_of(requests[i], model), point);
      record.progress().point(requests[i].name, point,
                              fraction_of(scene, point, done, requests.size()));
      return goes_on();
    };
    if (auto before = record.finished_curve(requests[i].name)) {
      results[i] = std::move(*before);
    } else if (auto earlier = kept_results.curve(requests[i])) {
      results[i] = std::move(*earlier);
    } else {
      const TimeOfCurve time(model, scene);
      // One share more, for what takes too long and for errors.
      share_time_among(1.0 + static_cast<double>(n_loaded(requests, order, place)) / jobs);
      results[i] = solve(requests[i], observe, nullptr);
      if (time.was_enough(results[i])) record.keep_finished(results[i]);
      if (time.changes_nothing(results[i])) kept_results.keep(results[i]);
    }
    ++done;
    const std::lock_guard lock(keeping);  // summary.json lists the curves in the scene's order
    finished[i] = true;
    for (; kept < finished.size() && finished[kept]; ++kept) {
      record.keep_curve(results[kept], model);
    }
  };
  // Of those that have ended, whichever were begun first.
  const auto keep_the_rest = [&] {
    for (; kept < finished.size(); ++kept) {
      if (finished[kept]) record.keep_curve(results[kept], model);
    }
  };
  try {
    tell_shares(share_curves(model, scene, requests.size(), jobs, trace), record.progress());
  } catch (const InterruptedError&) {
    keep_the_rest();
    throw;
  }
  share_time_among(1.0);
  stop_if_interrupted("points");
  return results;
}

std::vector<CurveResult> trace_again(const ReducedModel& model, const SceneDescription& scene,
                                     const std::vector<CurveRequest>& requests,
                                     const std::vector<const solver::ResponseCurve*>& near,
                                     int jobs, Progress& progress) {
  const KeptResults kept(model, scene);
  std::vector<CurveResult> results(requests.size());
  std::atomic<std::size_t> done{0};
  const auto trace = [&](std::size_t i, const CurveSolver& solve) {
    stop_if_interrupted("curves");
    const auto observe = [&](const solver::ResponsePoint& point) {
      progress.point(requests[i].name, point, fraction_of(scene, point, done, requests.size()));
      return goes_on();
    };
    const solver::ResponseCurve* begin = near.empty() ? nullptr : near[i];
    if (auto earlier = kept.curve(requests[i], begin)) {
      results[i] = std::move(*earlier);
    } else {
      const TimeOfCurve time(model, scene);
      results[i] = solve(requests[i], observe, begin);
      if (time.changes_nothing(results[i])) kept.keep(results[i], begin);
    }
    ++done;
  };
  tell_shares(share_curves(model, scene, requests.size(), jobs, trace), progress);
  stop_if_interrupted("curves");
  return results;
}

namespace {

/// @param needed  else there are none, and nothing is said.
RicherModels models_to_compare(const ReducedModel& model, const SceneDescription& scene,
                               const SolvedStructure* structure, bool needed) {
  RicherModels richer;
  if (!needed) return richer;
  if (!cut_short()) return richer_models(model, scene, structure);
  richer.note = "out of time: errors but those of the harmonics are not told";
  if (structure != nullptr) {
    richer.unknown = {"mesh", "basis", "cells", "fit", "second_direction"};
  }
  if (contact::is_sampled(model.patches, model.effects)) {
    richer.unknown.emplace_back("instants");
  }
  return richer;
}

}  // namespace

std::vector<CurveBudget> budgets_of(const ReducedModel& model, const SceneDescription& scene,
                                    const SolvedStructure* structure, int jobs,
                                    std::vector<CurveResult>& curves, Progress& progress) {
  if (!scene.accuracy.error_budget) return {};
  const bool is_given = structure == nullptr && model.patches.empty();
  if (is_given && effects_left_out(model, scene).empty()) return {};
  const KeptResults kept(model, scene);
  std::vector<std::optional<CurveBudget>> known(curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i) known[i] = kept.budget(curves[i]);
  const bool any_unknown =
      !std::ranges::all_of(known, [](const auto& budget) { return budget.has_value(); });
  const bool any_balanced =  // else there is no budget
      !std::ranges::all_of(curves, &CurveResult::integrated);
  const RicherModels richer =
      models_to_compare(model, scene, structure, any_unknown && any_balanced);
  if (!richer.note.empty()) progress.info(richer.note);
  const RicherModels others =
      any_unknown && !cut_short() ? models_left_out(model, scene, structure) : RicherModels{};
  if (!others.note.empty()) progress.info(others.note);
  std::vector<RicherModel> with = others.models;
  std::ranges::copy_if(richer.models, std::back_inserter(with),
                       [](const RicherModel& one) { return one.source == "second_direction"; });
  std::vector<CurveBudget> budgets(curves.size());
  in_parallel(curves.size(), jobs, [&](std::size_t i) {
    stop_if_interrupted("curves");
    if (known[i]) {
      budgets[i] = std::move(*known[i]);
      return;
    }
    budgets[i] = error_budget(model, scene, richer, curves[i]);
    budgets[i].no_bound = others.no_bound;
    if (cut_short()) return;
    if (budgets[i].has_bar()) budgets[i].along = harmonics_along(model, scene, curves[i]);
    budgets[i].left_out = rows_left_out(model, scene, others.models, curves[i]);
    std::vector<ErrorRow>& rows = budgets[i].left_out;
    const std::vector<IndicatorOfCurve> along = indicators_along(model, scene, with, curves[i]);
    for (const IndicatorOfCurve& one : along) rows.push_back(largest_along(one, curves[i]));
    std::vector<ErrorRow> told = budgets[i].rows;
    told.insert(told.end(), rows.begin(), rows.end());
    for (const ErrorRow& row : rows_there(model, scene, with, curves[i], along, told)) {
      rows.push_back(row);
    }
    kept.keep(budgets[i], curves[i]);
  });
  borrow_unknown(budgets);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (budgets[i].has_bar()) {
      curves[i].band = amplitude_band(curves[i], budgets[i]);
    }
  }
  return budgets;
}

namespace {

void draw_curve(const ReducedModel& model, const SceneDescription& scene, const CurveResult& curve,
                std::size_t number, const KeptResults& kept, RunRecord& record) {
  if (const std::optional<Pictures> before = kept.pictures(curve)) {
    record.keep_pictures(*before, number);
    return;
  }
  std::vector<std::string> names;
  std::vector<std::string> files;
  const auto add = [&](const std::vector<std::string>& more) {
    files.insert(files.end(), more.begin(), more.end());
  };
  const CurveMaps maps = curve_maps(model, scene, curve);
  for (const NamedMap& map : maps.maps) {
    add(record.keep_map(model, map, number));
    names.push_back(map.name);
  }
  for (const std::string& reason : maps.missing) record.progress().warning(reason);
  if (const auto* peak = highest_peak(curve.curve)) {
    add(record.keep_motion(curve.name + "_peak", *peak));
  }
  // What is missing is told in every run.
  if (ResultCache::in_use() == nullptr || !maps.missing.empty()) return;
  if (const auto drawn = record.pictures_of(names, files)) kept.keep(*drawn, curve);
}

}  // namespace

void draw_maps(const ReducedModel& model, const SceneDescription& scene,
               const std::vector<CurveResult>& curves, int jobs, RunRecord& record) {
  const KeptResults kept(model, scene);
  std::atomic<bool> late{false};
  in_parallel(curves.size(), jobs, [&](std::size_t i) {
    stop_if_interrupted("curves");
    if (cut_short()) {
      late = true;
      return;
    }
    const Progress::Part part = record.progress().part("maps and motion of " + curves[i].name);
    draw_curve(model, scene, curves[i], i, kept, record);
  });
  if (late)
    record.progress().warning(
        "out of time: maps and motions at the peaks are left out; give --budget more, or set "
        "response.maps = []");
}

}  // namespace microslip::pipelines
