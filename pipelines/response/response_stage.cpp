#include "pipelines/response/response_stage.hpp"

#include <limits>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "contact/phase.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/response/end_remedies.hpp"
#include "pipelines/response/harmonics_check.hpp"
#include "pipelines/response/resonating_shapes.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/response/time_response.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"

namespace microslip::pipelines {
namespace {

/// What each patch did at every point of a curve, where there are several.
void add_patch_shares(const ReducedModel& model, double load, CurveResult& result) {
  if (model.patches.size() < 2) return;
  const contact::ContactForce contact = contact_of(model, load);
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const auto force = contact.modal_force(i);
    const auto work = force->workspace();
    PatchShares& shares = result.patch_shares.emplace_back();
    shares.patch = model.patches[i].name;
    for (const solver::ResponsePoint& point : result.curve.points) {
      shares.reports.push_back(force->report(point.q, point.frequency, *work));
    }
  }
}

/// In the linear limits every patch does what all do.
void add_limit_shares(const ReducedModel& model, CurveResult& result) {
  if (model.patches.size() < 2) return;
  for (const contact::Patch& patch : model.patches) {
    PatchShares& shares = result.patch_shares.emplace_back();
    shares.patch = patch.name;
    for (const solver::ResponsePoint& point : result.curve.points) {
      shares.reports.push_back(point.report);
    }
  }
}

solver::ResponseCurve balanced_curve(const ReducedModel& model, const SceneDescription& scene,
                                     double load, const solver::ContinuationOptions& options,
                                     const solver::PointObserver& observe) {
  if (contact::is_sampled(model.patches, model.effects)) {
    return sampled_curve(model, scene, load, options, observe);
  }
  const solver::Scene problem = balanced_scene(model, load, options);
  const solver::ContinuationOptions searching = with_search_scene(options, model, load);
  return options.frequency_begin == options.frequency_end
             ? solver::solve_at_frequency(problem, options.frequency_begin, searching)
             : solver::trace_response(problem, searching, observe);
}

/// What a curve may take: where a run has a budget no more than leaves some of it for the others.
struct CurveTime {
  double seconds;
  std::string_view name;
  std::string_view remedy;
  bool is_share = false;  ///< of what all curves may take
};

CurveTime time_without_share(const SceneDescription& scene) {
  return {scene.response->time_budget, "response.time_budget", remedy_of_time()};
}

CurveTime time_of_curve(const SceneDescription& scene) {
  const CurveTime own = time_without_share(scene);
  const double share = share_of_time();
  if (!(share < own.seconds)) return own;
  return {share, "its share of accuracy.budget", "give more of it, or ask for fewer curves", true};
}

/// That its time was over is why it has no end, where nothing else has stopped it.
/// @return  whether it is.
bool tell_time_is_over(const CurveTime& time, solver::ResponseCurve& curve) {
  if (curve.diagnosis != solver::Diagnosis::interrupted) return false;
  if (interrupt_requested() || cut_short()) return false;
  curve.diagnosis = solver::Diagnosis::budget;
  curve.message = fmt::format("{}{}{}, {:.4g} s, is over", curve.message,
                              curve.message.empty() ? "" : ": ", time.name, time.seconds);
  return true;
}

constexpr std::string_view more_budget =
    "give accuracy.budget (--budget) more, and run without --resume: what was finished comes from "
    "the cache";

/// The same of the time of the whole run.
bool tell_run_is_over(solver::ResponseCurve& curve) {
  if (curve.diagnosis != solver::Diagnosis::interrupted) return false;
  if (interrupt_requested() || !cut_short()) return false;
  curve.diagnosis = solver::Diagnosis::budget;
  curve.message += fmt::format("{}accuracy.budget is over", curve.message.empty() ? "" : ": ");
  return true;
}

SceneDescription with_one_harmonic(SceneDescription scene) {
  scene.settings.harmonics = {.highest = 1};
  return scene;
}

/// One harmonic in the place of several, for which there was no time.
CurveResult told_lean(CurveResult lean, const CurveTime& time) {
  lean.lacks_time = true;
  lean.curve.message +=
      fmt::format("{}with one harmonic: with more {}, {:.4g} s, was over; {}",
                  lean.curve.message.empty() ? "" : "; ", time.name, time.seconds, time.remedy);
  return lean;
}

solver::ResponseCurve linear_curve(const ReducedModel& model, LimitName limit,
                                   solver::ContinuationOptions options) {
  options.residual_tolerance =
      solver::ContinuationOptions{}.residual_tolerance;  // nothing is sampled
  options.corrector = solver::ContinuationOptions::Corrector::newton;
  return solver::trace_linear(
      limit_scene(model),
      limit == LimitName::free ? solver::LinearLimit::free : solver::LinearLimit::stuck, options);
}

CurveResult nothing_yet(const ReducedModel& model, const CurveRequest& request) {
  CurveResult result;
  result.name = request.name;
  result.load = load_of(request, model);
  result.gap = gap_of(result.load, model);
  return result;
}

/// Traces the curve of a scene; the harmonics it has are not checked with more.
CurveResult traced(const ReducedModel& model, const SceneDescription& scene,
                   const CurveRequest& request, const solver::PointObserver& observe,
                   solver::ContinuationOptions options, const solver::ResponseCurve* near) {
  CurveResult result = nothing_yet(model, request);
  if (const auto* limit = std::get_if<LimitName>(&result.load)) {
    result.curve = linear_curve(model, *limit, std::move(options));
    add_limit_shares(model, result);
    return result;
  }
  const double load = std::get<double>(result.load);
  if (scene.response->method == ResponseDescription::Method::time) {
    const Eigen::VectorXd factors = slowing_of(model, *scene.response);
    const auto in_modes = [&](solver::ResponsePoint point) {
      point.q.rows() *= factors.asDiagonal();
      if (!scene.judges_stability) point.stability = solver::Stability::not_assessed;
      return point;
    };
    result.curve = integrate_curve(
        integrated_scene(model, *scene.response, load), scene,
        [&](const auto& point) { return observe(in_modes(point)); }, options.stop);
    for (solver::ResponsePoint& point : result.curve.points) point = in_modes(point);
    result.integrated = true;
    const double all = std::numeric_limits<double>::infinity();
    tell_shapes_resonate(model.frequency.cwiseProduct(factors), model.n_attachment, all,
                         result.curve);
    add_patch_shares(model, load, result);
    return result;
  }
  options.search_starts = search_starts(scene, model, load);
  if (near != nullptr && !near->points.empty() &&
      near->points.front().frequency == options.frequency_begin) {
    options.near_begin = near->points.front().q;
  }
  result.curve = balanced_curve(model, scene, load, options, observe);
  const double highest =
      result.curve.points.empty() ? 0 : result.curve.points.front().q.n_harmonics();
  tell_shapes_resonate(model.frequency, model.n_attachment, highest, result.curve);
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  if (harmonics.chosen() && harmonics.tolerance < close_choice) {
    tell_unasked(options.n_harmonics, harmonics.highest, result.curve);
  }
  add_patch_shares(model, load, result);
  return result;
}

}  // namespace

solver::ResponseCurve limit_curve(const ReducedModel& model, const SceneDescription& scene,
                                  LimitName limit) {
  return linear_curve(model, limit, continuation_options(scene, model));
}

namespace {

/// trace_curve() within a time.
CurveResult traced_within(const CurveTime& time, const ReducedModel& model,
                          const SceneDescription& scene, const CurveRequest& request,
                          const solver::PointObserver& observe, const solver::ResponseCurve* near) {
  const TimeLimit limit(time.seconds);
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.stop = [&limit, stop = options.stop] { return limit.is_over() || stop(); };
  const auto within = [&](const auto& point) { return !limit.is_over() && observe(point); };
  CurveResult result = traced(model, scene, request, within, options, near);
  const bool is_over = limit.is_over();
  const bool has_end = result.curve.complete || interrupt_requested() || cut_short();
  if (is_over && time.is_share && scene.settings.harmonics.or_one && !has_end) {
    CurveResult lean = traced_within(time_without_share(scene), model, with_one_harmonic(scene),
                                     request, observe, near);
    if (lean.curve.complete) return told_lean(std::move(lean), time);
  }
  const bool by_time = is_over && tell_time_is_over(time, result.curve);
  const bool by_run = !by_time && tell_run_is_over(result.curve);
  tell_remedy(by_time  ? time.remedy
              : by_run ? more_budget
                       : remedy_of(result.curve.diagnosis, scene.response->method),
              result.curve);
  if (is_over) return result;
  const auto* load = std::get_if<double>(&result.load);
  if (load != nullptr && !result.integrated) {
    const TimeLimit of_check(share_of_check * scene.accuracy.budget);
    check_harmonics(model, scene, *load, result,
                    [&] { return limit.is_over() || of_check.is_over(); });
  }
  return result;
}

}  // namespace

CurveResult trace_curve(const ReducedModel& model, const SceneDescription& scene,
                        const CurveRequest& request, const solver::PointObserver& observe,
                        const solver::ResponseCurve* near) {
  return traced_within(time_of_curve(scene), model, scene, request, observe, near);
}

CurveResult checked_curve(const ReducedModel& model, const SceneDescription& scene,
                          const CurveRequest& request, solver::ResponseCurve curve) {
  CurveResult result = nothing_yet(model, request);
  result.curve = std::move(curve);
  check_harmonics(model, scene, std::get<double>(result.load), result);
  return result;
}

solver::ResponseCurve integrated_elsewhere(const ReducedModel& model, const SceneDescription& scene,
                                           double load, const solver::ResponsePoint& point,
                                           const Eigen::MatrixXd& embedding, Closeness closely) {
  contact::Harmonics begin(point.q.n_harmonics(), model.frequency.size());
  begin.rows() = point.q.rows();
  if (embedding.size() > 0) begin.rows() = point.q.rows() * embedding.transpose();
  const Eigen::VectorXd factors = slowing_of(model, *scene.response);
  begin.rows() *= factors.cwiseInverse().asDiagonal();
  const auto stop = [] { return interrupt_requested() || cut_short(); };
  return integrate_curve(integrated_scene(model, *scene.response, load), scene, {}, stop, &begin,
                         closely);
}

}  // namespace microslip::pipelines
