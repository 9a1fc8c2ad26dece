#include "pipelines/response/response_stage.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contact/dense.hpp"
#include "contact/phase.hpp"
#include "pipelines/effects/contact_effects.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/model/slow_attachment.hpp"
#include "pipelines/model/tilted_area.hpp"
#include "pipelines/response/end_remedies.hpp"
#include "pipelines/response/resonating_shapes.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/time_response.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

// Of the balance where forces are sampled: they err by 1e-5, and kinks between instants make the
// last digits dear.
constexpr double sampled_tolerance = 1e-9;

contact::Harmonics excitation(const ReducedModel& model, int n_harmonics) {
  contact::Harmonics force(n_harmonics, model.frequency.size());
  force.rows().row(0) = model.force_static;
  force.rows().row(1) = model.force_sine;
  force.rows().row(2) = model.force_cosine;
  return force;
}

/// One per patch.
std::vector<NamedMap> maps_of(const ReducedModel& model, const SceneDescription& scene, double load,
                              const std::string& name, const solver::ResponsePoint& point) {
  const int phases = scene.response->map_phases;
  const contact::ContactForce contact = contact_of(model, load);
  std::vector<NamedMap> maps;
  for (std::size_t patch = 0; patch < model.patches.size(); ++patch) {
    const auto draw = [&](contact::Places places) {
      return or_refused(
          [&] { return contact.map(patch, places, point.q, point.frequency, phases); });
    };
    NamedMap map;
    map.name = model.patches.size() == 1 ? name : name + "." + model.patches[patch].name;
    map.patch = patch;
    map.frequency_hz = point.frequency / contact::two_pi;
    map.amplitude = point.amplitude;
    map.stability = point.stability;
    map.points = draw(contact::Places::cells);
    if (model.patches[patch].vertices.size() > 0) map.vertices = draw(contact::Places::vertices);
    maps.push_back(std::move(map));
  }
  return maps;
}

std::unique_ptr<contact::TransientForce> transient_force(const ReducedModel& model, double load) {
  return model.patches.empty() ? nullptr : contact_of(model, load).transient_force();
}

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

Eigen::VectorXd slowing_of(const ReducedModel& model, const ResponseDescription& response) {
  return slowing(
      model, contact::two_pi * std::max(response.frequency_begin_hz, response.frequency_end_hz));
}

/// Explicit steps need not follow attachment shapes, see slow_attachment.hpp.
solver::Scene integrated_scene(const ReducedModel& model, const ResponseDescription& response,
                               double load) {
  const ReducedModel slow = slowed(model, slowing_of(model, response));
  solver::Scene problem = solver_scene(slow, load);
  problem.transient = transient_force(slow, load);
  return problem;
}

}  // namespace

solver::Scene solver_scene(const ReducedModel& model, double load) {
  solver::Scene scene;
  scene.natural_frequency = model.frequency;
  scene.damping_ratio = model.damping_ratio;
  scene.excitation = excitation(model, model.effects.n_harmonics);
  scene.output = model.output;
  if (!model.patches.empty()) scene.contact = contact_of(model, load).modal_force();
  return scene;
}

solver::Scene limit_scene(ReducedModel model) {
  model.coordinates = {};
  for (contact::Patch& patch : model.patches) {
    patch.tilted_areas.clear();
    patch.rules.roughness.reset();
  }
  return solver_scene(model, 1.0);
}

void require_response(const SceneDescription& scene) {
  if (!scene.response) {
    throw SceneError(scene.file.string() + ": [response] is missing: run needs a frequency range");
  }
  if (!scene.without_contact.empty()) throw SceneError(scene.without_contact);
  require_pressing_loads(scene);
}

void require_held(const ReducedModel& model, const SceneDescription& scene) {
  const Eigen::Index n_rigid = (model.frequency.array() == 0.0).count();
  if (n_rigid == 0) return;
  const solver::Scene problem = limit_scene(model);
  Eigen::MatrixXd stuck = model.frequency.array().square().matrix().asDiagonal();
  if (problem.contact) stuck += problem.contact->stuck_stiffness();
  const Eigen::Index n_loose = contact::nullity(stuck);
  if (n_loose == 0) return;
  const bool has_supports = !std::holds_alternative<ModalModel>(scene.model);
  throw RefusedError(fmt::format(
      "rigid-body: {} of the {} modes are rigid-body motions and nothing holds them ({} stay free "
      "even "
      "with every contact point stuck): {}",
      n_rigid, model.frequency.size(), n_loose,
      has_supports
          ? "name the clamped surfaces in [supports] clamped"
          : "give contact points whose stiffness holds them, or leave the modes of 0 Hz out"));
}

Eigen::VectorXd stuck_frequencies(const ReducedModel& model) {
  const solver::Scene scene = limit_scene(model);
  Eigen::MatrixXd K = model.frequency.array().square().matrix().asDiagonal();
  if (scene.contact) K += scene.contact->stuck_stiffness();
  const auto squares = contact::symmetric_eigenvalues(K);
  if (!squares) throw std::runtime_error("the eigenvalues of the stuck structure do not converge");
  return squares->cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

void require_loads(const ReducedModel& model, const SceneDescription& scene) {
  const bool tilts = std::ranges::any_of(
      model.patches, [](const contact::Patch& patch) { return !patch.tilted_areas.empty(); });
  if (!tilts) return;
  for (const CurveRequest& request : curve_requests(scene)) {
    const auto asked = load_of(request, model);
    const auto* load = std::get_if<double>(&asked);
    if (load != nullptr) static_cast<void>(contact_of(model, *load));
  }
  const auto& optimum = scene.response->optimum;
  if (optimum && optimum->of_preload() && optimum->range) {
    static_cast<void>(contact_of(model, (*optimum->range)[0]));
  }
}

void require_curves(const ReducedModel& model, const SceneDescription& scene) {
  require_loads(model, scene);
  const bool in_time = scene.response->method == ResponseDescription::Method::time;
  for (const CurveRequest& request : curve_requests(scene)) {
    const auto asked = load_of(request, model);
    if (const auto* load = std::get_if<double>(&asked); load != nullptr && in_time) {
      require_steps(integrated_scene(model, *scene.response, *load), *scene.response);
    }
  }
}

namespace {

/// Chosen harmonics end where the modes do: beyond, a harmonic meets resonances of attachment
/// shapes, which no structure has. The first nine are always meant:
/// attachment shapes answer them like springs.
int most_meant(const ReducedModel& model, const ResponseDescription& response, int highest) {
  if (model.n_attachment == 0) return highest;
  constexpr int least = 9;
  const Eigen::Index n_free = model.frequency.size() - model.n_attachment;
  const double top = n_free > 0 ? model.frequency.head(n_free).maxCoeff() : 0.0;
  const double lowest =
      contact::two_pi * std::min(response.frequency_begin_hz, response.frequency_end_hz);
  const double orders = std::min(std::floor(top / lowest), static_cast<double>(highest));
  return std::clamp(static_cast<int>(orders), std::min(least, highest), highest);
}

bool has_constant_load(const contact::Patch& patch, const ContactEffects& effects) {
  return !effects.normal_motion || patch.cells.shapes.v.isZero(0.0) ||
         patch.cells.stiffness.col(1).isZero(0.0);
}

/// Forces of contact change sign with the motion, and the excitation half a period later: so does
/// the motion (theory 13).
bool has_odd_motions(const ReducedModel& model) {
  return model.force_static.isZero(0.0) &&
         std::ranges::all_of(model.patches, [&](const contact::Patch& patch) {
           return patch.rules.plain() && has_constant_load(patch, model.effects);
         });
}

/// With the highest, so that tables have the columns that are asked for.
std::vector<int> odd_orders(int highest) {
  std::vector<int> orders;
  for (int k = 1; k < highest; k += 2) orders.push_back(k);
  orders.push_back(highest);
  return orders;
}

}  // namespace

solver::ContinuationOptions continuation_options(const SceneDescription& scene,
                                                 const ReducedModel& model) {
  const ResponseDescription& response = *scene.response;
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  solver::ContinuationOptions options;
  options.frequency_begin = contact::two_pi * response.frequency_begin_hz;
  options.frequency_end = contact::two_pi * response.frequency_end_hz;
  options.n_harmonics =
      harmonics.chosen() ? most_meant(model, response, harmonics.highest) : harmonics.highest;
  options.orders = harmonics.orders;
  const bool given = options.orders.empty() && !harmonics.chosen();
  if (given && has_odd_motions(model)) {
    options.orders = odd_orders(harmonics.highest);
    options.without_mean = true;
  }
  options.harmonic_tolerance = harmonics.tolerance;
  options.search_starts = asked_starts(scene);
  options.judge_stability = scene.judges_stability;
  options.linear_certificate = setting_of(scene, "nonlinearity") != "on";
  options.stop = [] { return interrupt_requested() || cut_short(); };
  if (contact::is_sampled(model.patches, model.effects)) {
    options.residual_tolerance = sampled_tolerance;
    options.corrector = solver::ContinuationOptions::Corrector::few_jacobians;
  }
  return options;
}

solver::Scene balanced_scene(const ReducedModel& model, double load,
                             const solver::ContinuationOptions& options) {
  solver::Scene problem = solver_scene(model, load);
  // A period map moves the mean as well.
  const bool maps_period = options.n_harmonics > 1 && model.effects.mean_coupling;
  if (maps_period) problem.transient = transient_force(model, load);
  return problem;
}

int harmonics_to_check(const ReducedModel& model, const SceneDescription& scene) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  constexpr int most_harmonics = 99;   // of a scene
  constexpr int most_unknowns = 1500;  // seconds a step beyond
  if (harmonics.chosen() || !harmonics.checked || model.patches.empty()) return 0;
  const int highest = std::min(harmonics.highest + harmonics_of_a_check, most_harmonics);
  if (highest <= harmonics.highest + harmonics_of_a_check / 2) return 0;
  return static_cast<int>(model.frequency.size()) * (2 * highest + 1) <= most_unknowns ? highest
                                                                                       : 0;
}

namespace {

/// The highest peak of a curve traced with more harmonics about the one that the curve has: where
/// that is too far for Newton's method.
void trace_about_peak(const ReducedModel& model, double load, solver::ContinuationOptions options,
                      CurveResult& result) {
  constexpr double beside =
      0.015;  // of the frequency: some resonance widths of a lightly damped blade
  solver::RicherPeak& richer = *result.richer;
  const double top = highest_peak(result.curve)->frequency;
  for (double* end : {&options.frequency_begin, &options.frequency_end}) {
    *end = std::clamp(*end, (1.0 - beside) * top, (1.0 + beside) * top);
  }
  const auto begin = std::chrono::steady_clock::now();
  const solver::ResponseCurve curve =
      solver::trace_response(balanced_scene(model, load, options), options,
                             [&options](const auto&) { return !options.stop(); });
  richer.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const solver::ResponsePoint* peak = highest_peak(curve);
  if (!curve.complete || peak == nullptr || peak->mark != solver::PointMark::peak) return;
  richer.frequency = peak->frequency;
  richer.amplitude = peak->amplitude;
  richer.dissipated_energy = peak->energy.friction;
  richer.change = 1.0 - highest_peak(result.curve)->amplitude / peak->amplitude;
}

}  // namespace

void check_harmonics(ReducedModel model, const SceneDescription& scene, double load,
                     CurveResult& result, const std::function<bool()>& stop) {
  solver::ResponseCurve& curve = result.curve;
  const int highest = harmonics_to_check(model, scene);
  if (highest == 0 || !curve.certificate.empty() || curve.points.empty()) return;
  if (curve.diagnosis == solver::Diagnosis::interrupted || interrupt_requested() || cut_short())
    return;
  model.effects.n_harmonics = highest;
  model = model_of(std::move(model), curve);
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.search_starts = 0;
  options.judge_stability = false;
  options.stop = [&stop, others = options.stop] { return stop() || others(); };
  result.richer = solver::richer_peak(solver_scene(model, load), options, curve, highest);
  const bool missed = result.richer && !result.richer->change;
  if (missed && options.frequency_begin != options.frequency_end) {
    options.n_harmonics = highest;
    options.orders.clear();
    trace_about_peak(model, load, options, result);
  }
  if (result.richer && !result.richer->change && options.stop()) {
    result.richer.reset();  // not known, which is another thing than not found
    curve.message += fmt::format("{}stopped before its harmonics were checked",
                                 curve.message.empty() ? "" : "; ");
  }
}

namespace {

solver::ResponseCurve balanced_curve(const ReducedModel& model, const SceneDescription& scene,
                                     double load, const solver::ContinuationOptions& options,
                                     const solver::PointObserver& observe) {
  if (contact::is_sampled(model.patches, model.effects)) {
    return sampled_curve(model, scene, load, options, observe);
  }
  const solver::Scene problem = balanced_scene(model, load, options);
  return options.frequency_begin == options.frequency_end
             ? solver::solve_at_frequency(problem, options.frequency_begin, options)
             : solver::trace_response(problem, options, observe);
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

/// Traces the curve of a scene; the harmonics it has are not checked with more.
CurveResult traced(const ReducedModel& model, const SceneDescription& scene,
                   const CurveRequest& request, const solver::PointObserver& observe,
                   solver::ContinuationOptions options, const solver::ResponseCurve* near) {
  CurveResult result;
  result.name = request.name;
  result.load = load_of(request, model);
  result.gap = gap_of(result.load, model);
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
  tell_remedy(by_time ? time.remedy : remedy_of(result.curve.diagnosis, scene.response->method),
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

solver::ResponseCurve integrated_elsewhere(const ReducedModel& model, const SceneDescription& scene,
                                           double load, const solver::ResponsePoint& point,
                                           const Eigen::MatrixXd& embedding) {
  contact::Harmonics begin(point.q.n_harmonics(), model.frequency.size());
  begin.rows() = point.q.rows();
  if (embedding.size() > 0) begin.rows() = point.q.rows() * embedding.transpose();
  const Eigen::VectorXd factors = slowing_of(model, *scene.response);
  begin.rows() *= factors.cwiseInverse().asDiagonal();
  const auto stop = [] { return interrupt_requested() || cut_short(); };
  return integrate_curve(integrated_scene(model, *scene.response, load), scene, {}, stop, &begin);
}

const solver::ResponsePoint* highest_peak(const solver::ResponseCurve& curve) {
  const solver::ResponsePoint* best = nullptr;
  for (const bool marked : {true, false}) {
    for (const solver::ResponsePoint& point : curve.points) {
      if (marked && point.mark != solver::PointMark::peak) continue;
      if (best == nullptr || point.amplitude > best->amplitude) best = &point;
    }
    if (best != nullptr) return best;
  }
  return nullptr;
}

CurveMaps curve_maps(const ReducedModel& model, const SceneDescription& scene,
                     const CurveResult& result) {
  CurveMaps drawn;
  const auto* load = std::get_if<double>(&result.load);
  if (load == nullptr || model.patches.empty()) return drawn;
  const auto add = [&](const std::string& suffix, const solver::ResponsePoint& point) {
    for (NamedMap& map : maps_of(model, scene, *load, result.name + "_" + suffix, point)) {
      drawn.maps.push_back(std::move(map));
    }
  };
  const ReducedModel solved = model_of(model, result.curve);
  const solver::ContinuationOptions options = continuation_options(scene, solved);
  for (const MapEntry& entry : scene.response->maps) {
    if (const auto* frequency = std::get_if<double>(&entry)) {
      const ResponseDescription& range = *scene.response;
      const bool solved_there =
          *frequency == range.frequency_begin_hz && *frequency == range.frequency_end_hz;
      const auto points = solved_there ? result.curve.points
                                       : solver::points_at_frequency(
                                             balanced_scene(solved, *load, options), result.curve,
                                             contact::two_pi * *frequency, options);
      for (std::size_t i = 0; i < points.size(); ++i) {
        add(fmt::format("{:g}Hz_{}", *frequency, i + 1), points[i]);
      }
      if (points.empty()) {
        drawn.missing.push_back(
            fmt::format("curve {}: no map at {:g} Hz, where it has no solution, or none whose "
                        "proof passes: set response.maps "
                        "to frequencies that it passes, or response.frequency to a range with it",
                        result.name, *frequency));
      }
    } else if (std::get<MapName>(entry) == MapName::peak) {
      if (const auto* peak = highest_peak(result.curve)) add("peak", *peak);
    } else {
      int count = 0;
      for (const solver::ResponsePoint& point : result.curve.points) {
        if (point.mark == solver::PointMark::fold) add(fmt::format("fold_{}", ++count), point);
      }
    }
  }
  return drawn;
}

}  // namespace microslip::pipelines
