#include "pipelines/response/response_stage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "contact/dense.hpp"
#include "pipelines/model/contact_effects.hpp"
#include "pipelines/model/point_parameters.hpp"
#include "pipelines/model/slow_attachment.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/model/tilted_area.hpp"
#include "pipelines/response/time_response.hpp"

namespace microslip::pipelines {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
// Of the balance where forces are sampled: they err by 1e-5, and kinks between instants make the last digits dear.
constexpr double sampled_tolerance = 1e-9;

contact::Harmonics excitation(const ReducedModel& model, int n_harmonics) {
  contact::Harmonics force(n_harmonics, model.frequency.size());
  force.rows().row(0) = model.force_static;
  force.rows().row(1) = model.force_sine;
  force.rows().row(2) = model.force_cosine;
  return force;
}

NamedMap map_of(const ReducedModel& model, const SceneDescription& scene, double load,
                const std::string& name, const solver::ResponsePoint& point) {
  const double wear = scene.contact ? scene.contact->wear_coefficient : scene.wear_coefficient;
  const int phases = scene.response->map_phases;
  NamedMap map;
  map.name = name;
  map.frequency_hz = point.frequency / two_pi;
  map.amplitude = point.amplitude;
  map.stability = point.stability;
  const bool closed_form = model.effects.closed_form();
  const auto draw = [&](bool on_vertices) {
    const contact::ModalShapes shapes = simulated_shapes(model, on_vertices);
    if (closed_form) {
      return contact::contact_map(point_parameters(model, load, on_vertices), shapes, point.q, phases, wear);
    }
    contact::ContactMap drawn = contact::contact_map(point_laws(model, load, on_vertices), shapes, point.q,
                                                     point.frequency, phases, wear);
    contact::add_guards(drawn, point_surfaces(model, load, on_vertices), shapes, point.q, point.frequency);
    return drawn;
  };
  map.points = draw(false);
  if (model.vertices.rows() > 0) map.vertices = draw(true);
  return map;
}

Eigen::VectorXd slowing_of(const ReducedModel& model, const ResponseDescription& response) {
  return slowing(model, two_pi * std::max(response.frequency_begin_hz, response.frequency_end_hz));
}

/// Explicit steps need not follow attachment shapes, see slow_attachment.hpp.
solver::Scene integrated_scene(const ReducedModel& model, const ResponseDescription& response, double load) {
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
  scene.contact = contact_force(model, load);
  return scene;
}

solver::Scene limit_scene(ReducedModel model) {
  model.tilted_areas.clear();
  model.effects.roughness.reset();
  return solver_scene(model, 1.0);
}

void require_response(const SceneDescription& scene) {
  if (!scene.response) {
    throw SceneError(scene.file.string() + ": [response] is missing: run needs a frequency range");
  }
  if (!scene.without_contact.empty()) throw SceneError(scene.without_contact);
  require_pressing_loads(scene);
}

/// Numbers that are finite one by one may leave the range of double precision together.
void require_finite(const ReducedModel& model, const SceneDescription& scene) {
  const auto require = [&](const char* what, double sum) {
    if (std::isfinite(sum)) return;
    throw SceneError(fmt::format("{}: {} comes to more than double precision holds: are all units right?",
                                 scene.file.string(), what));
  };
  require("a natural frequency", model.frequency.squaredNorm());
  require("the excitation", model.force_sine.squaredNorm() + model.force_cosine.squaredNorm());
  require("the output", model.output.squaredNorm());
  require("the normal stiffness of the contact", model.normal_stiffness.dot(model.weights));
  require("the tangential stiffness of the contact", model.tangential_stiffness.dot(model.weights));
  require("the preload of the contact", model.preload.dot(model.weights));
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
      "rigid-body: {} of the {} modes are rigid-body motions and nothing holds them ({} stay free even "
      "with every contact point stuck): {}",
      n_rigid, model.frequency.size(), n_loose,
      has_supports ? "name the clamped surfaces in [supports] clamped"
                   : "give contact points whose stiffness holds them, or leave the modes of 0 Hz out"));
}

void require_loads(const ReducedModel& model, const SceneDescription& scene) {
  for (const TiltedArea& area : model.tilted_areas) {
    for (const CurveRequest& request : curve_requests(scene)) {
      const auto preload = preload_of(request, model);
      const auto* load = std::get_if<double>(&preload);
      if (load != nullptr) static_cast<void>(tilted_pressures(model, area, *load, false));
    }
    const auto& optimum = scene.response->optimum;
    if (optimum && optimum->of_preload() && optimum->range) {
      static_cast<void>(tilted_pressures(model, area, (*optimum->range)[0], false));
    }
  }
}

void require_curves(const ReducedModel& model, const SceneDescription& scene) {
  require_finite(model, scene);
  require_loads(model, scene);
  const bool in_time = scene.response->method == ResponseDescription::Method::time;
  for (const CurveRequest& request : curve_requests(scene)) {
    const auto preload = preload_of(request, model);
    if (const auto* load = std::get_if<double>(&preload); load != nullptr && in_time) {
      require_steps(integrated_scene(model, *scene.response, *load), *scene.response);
    }
  }
}

solver::ContinuationOptions continuation_options(const ResponseDescription& response,
                                                 const ReducedModel& model) {
  solver::ContinuationOptions options;
  options.frequency_begin = two_pi * response.frequency_begin_hz;
  options.frequency_end = two_pi * response.frequency_end_hz;
  options.n_harmonics = response.harmonics;
  options.orders = response.harmonic_orders;
  options.harmonic_tolerance = response.harmonic_tolerance;
  options.search_starts = response.search_starts;
  if (is_sampled(model)) {
    options.residual_tolerance = sampled_tolerance;
    options.corrector = solver::ContinuationOptions::Corrector::few_jacobians;
  }
  return options;
}

/// With the contact in time where that judges stability (solver/stability.hpp).
solver::Scene balanced_scene(const ReducedModel& model, double load,
                             const solver::ContinuationOptions& options) {
  solver::Scene problem = solver_scene(model, load);
  if (options.n_harmonics > 1) problem.transient = transient_force(model, load);
  return problem;
}

CurveResult trace_curve(const ReducedModel& model, const SceneDescription& scene,
                        const CurveRequest& request, const solver::PointObserver& observe) {
  const solver::ContinuationOptions options = continuation_options(*scene.response, model);
  CurveResult result{request.name, preload_of(request, model), {}, {}, {}};
  if (const auto* gap = std::get_if<UniformGap>(&request.preload)) result.gap = gap->width;
  if (const auto* limit = std::get_if<LimitName>(&result.preload)) {
    result.curve = solver::trace_linear(limit_scene(model),
                                        *limit == LimitName::free ? solver::LinearLimit::free
                                                                  : solver::LinearLimit::stuck,
                                        options);
    return result;
  }
  const double load = std::get<double>(result.preload);
  if (scene.response->method == ResponseDescription::Method::time) {
    const Eigen::VectorXd factors = slowing_of(model, *scene.response);
    const auto in_modes = [&](solver::ResponsePoint point) {
      point.q.rows() *= factors.asDiagonal();
      return point;
    };
    result.curve = integrate_curve(integrated_scene(model, *scene.response, load), *scene.response,
                                   [&](const auto& point) { return observe(in_modes(point)); });
    for (solver::ResponsePoint& point : result.curve.points) point = in_modes(point);
    result.integrated = true;
    return result;
  }
  const solver::Scene problem = balanced_scene(model, load, options);
  result.curve = options.frequency_begin == options.frequency_end
                     ? solver::solve_at_frequency(problem, options.frequency_begin, options)
                     : solver::trace_response(problem, options, observe);
  return result;
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

std::vector<NamedMap> curve_maps(const ReducedModel& model, const SceneDescription& scene,
                                 const CurveResult& result) {
  std::vector<NamedMap> maps;
  const auto* load = std::get_if<double>(&result.preload);
  if (load == nullptr || model.weights.size() == 0) return maps;
  const auto add = [&](const std::string& suffix, const solver::ResponsePoint& point) {
    maps.push_back(map_of(model, scene, *load, result.name + "_" + suffix, point));
  };
  const solver::ContinuationOptions options = continuation_options(*scene.response, model);
  for (const MapEntry& entry : scene.response->maps) {
    if (const auto* frequency = std::get_if<double>(&entry)) {
      const ResponseDescription& range = *scene.response;
      const bool solved_there = *frequency == range.frequency_begin_hz &&
                                *frequency == range.frequency_end_hz;
      const auto points =
          solved_there ? result.curve.points
                       : solver::points_at_frequency(balanced_scene(model, *load, options), result.curve,
                                                     two_pi * *frequency, options);
      for (std::size_t i = 0; i < points.size(); ++i) {
        add(fmt::format("{:g}Hz_{}", *frequency, i + 1), points[i]);
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
  return maps;
}

}  // namespace microslip::pipelines
