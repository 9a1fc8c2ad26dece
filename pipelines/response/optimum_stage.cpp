#include "pipelines/response/optimum_stage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "pipelines/description/curve_request.hpp"
#include "pipelines/model/contact_factors.hpp"
#include "pipelines/response/end_remedies.hpp"
#include "pipelines/response/harmonics_check.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/in_parallel.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"
#include "solver/continuation.hpp"

namespace microslip::pipelines {
namespace {

constexpr const char* friction = "friction_coefficient";  // of the bracket

solver::OptimumOptions optimum_options(const SceneDescription& scene) {
  // Shares of what is asked for: a valley is level, and values over some per cent are as good.
  constexpr double of_value = 0.5;
  constexpr double of_amplitude = 0.25;
  solver::OptimumOptions options;
  if (scene.response->optimum->range) {
    options.lower = (*scene.response->optimum->range)[0];
    options.upper = (*scene.response->optimum->range)[1];
  } else {
    options.lower = std::numeric_limits<double>::infinity();
    for (const CurveRequest& request : curve_requests(scene)) {
      const auto* load = std::get_if<double>(&request.load);
      if (load == nullptr || *load <= 0.0) continue;
      options.lower = std::min(options.lower, *load);
      options.upper = std::max(options.upper, *load);
    }
  }
  if (!(options.lower < options.upper)) {
    throw SceneError(
        "response.optimum: needs response.optimum_range = [low, high], or two positive preloads");
  }
  if (!(options.lower > 0.0)) options.scale = solver::ParameterScale::linear;
  if (has_short_search(scene)) {
    const double asked = scene.accuracy.tolerance;
    options.relative_tolerance = std::clamp(of_value * asked, 5e-3, 2e-2);
    options.amplitude_tolerance = std::clamp(of_amplitude * asked, 3e-3, 1e-2);
  }
  return options;
}

}  // namespace

OptimumSearch::OptimumSearch(const ReducedModel& model, const SceneDescription& scene,
                             std::shared_ptr<const SolvedStructure> structure, int jobs)
    : model_(model),
      scene_(scene),
      request_(*scene.response->optimum),
      structure_(std::move(structure)),
      family_(scene, request_.key, model, structure_),
      // Another number may need other modes, which one thread alone may ask for.
      jobs_(request_.of_preload() ? jobs : 1),
      options_(optimum_options(scene)) {}

const ReducedModel& OptimumSearch::model_at(double value, double stiffness_factor) {
  const std::lock_guard lock(family_mutex_);  // what it gives stays where it is
  if (!request_.of_preload()) return family_.at(value, stiffness_factor);
  return stiffness_factor == 1.0 ? model_ : family_.as_given(stiffness_factor);
}

double OptimumSearch::load_at(double value, const ReducedModel& model) const {
  if (request_.of_preload()) return value;
  return request_.load ? *request_.load : model.static_preload.value();
}

SearchedScene OptimumSearch::at(double value) {
  if (request_.of_preload()) return {value, value, scene_, model_, structure_};
  SearchedScene found{value, 0.0, family_.scene_at(value), model_at(value, 1.0),
                      family_.structure_at(value)};
  found.load = load_at(value, found.model);
  return found;
}

solver::Scene OptimumSearch::scene_at(double value, const Factors& factors) {
  const bool by_keys = stiffness_place(scene_) == StiffnessPlace::keys;
  const ReducedModel& given = model_at(value, 1.0);
  const double given_load = load_at(value, given);
  ReducedModel model = by_keys ? model_at(value, factors.stiffness)
                               : with_point_stiffness(given, factors.stiffness, given_load);
  const double load = with_same_gap(load_at(value, model), given, model);
  if (factors.friction != 1.0) model = with_friction(std::move(model), factors.friction);
  if (factors.n_harmonics > 0) model.effects.n_harmonics = factors.n_harmonics;
  return solver_scene(model, load);
}

solver::OptimumOptions OptimumSearch::options_for(const Factors& factors) const {
  solver::OptimumOptions options = options_;
  if (factors.friction != 1.0 || factors.stiffness != 1.0) options.search_starts = 0;
  if (request_.of_preload()) {
    // Friction acts through μ n: the best preload moves by up to 1/factor, less where the normal
    // load varies with the motion.
    options.lower = std::min(options.lower, options.lower / factors.friction);
    options.upper = std::max(options.upper, options.upper / factors.friction);
  }
  return options;
}

solver::Optimum OptimumSearch::search(const Factors& factors, int jobs) {
  solver::ContinuationOptions range = continuation_options(scene_, model_);
  if (factors.n_harmonics > 0) {
    range.n_harmonics = factors.n_harmonics;
    range.orders.clear();
    range.harmonic_tolerance = 0.0;
  }
  solver::OptimumOptions options = options_for(factors);
  // Curves of a search are not written.
  constexpr double closely_enough = 1e-7;
  if (has_short_search(scene_)) {
    range.residual_tolerance = std::max(range.residual_tolerance, closely_enough);
  }
  options.together = [jobs](std::size_t n, const auto& task) { in_parallel(n, jobs, task); };
  solver::Optimum optimum =
      solver::minimise_peak([&](double value) { return scene_at(value, factors); }, range, options);
  tell_remedy(remedy_of(optimum.reason), optimum);
  return optimum;
}

std::string OptimumSearch::warning() const {
  const ResponseDescription& response = *scene_.response;
  if (response.method != ResponseDescription::Method::time) return "";
  const int highest = scene_.settings.harmonics.highest;
  const std::string harmonics =
      highest == 1 ? "1 harmonic" : fmt::format("harmonics up to {}", highest);
  return fmt::format(
      "response.optimum: searched by harmonic balance with {}, not by integration in time as the "
      "curves: "
      "integrate a curve at the best value to compare",
      harmonics);
}

solver::Optimum OptimumSearch::best() {
  solver::Optimum optimum = search({}, jobs_);
  by_few_ = optimum.by_few;
  if (const std::string text = warning(); !text.empty()) {
    optimum.notes.insert(optimum.notes.begin(), text);
  }
  return optimum;
}

/// The peak at a value, traced with the harmonics given and solved again with more.
std::optional<solver::RicherPeak> OptimumSearch::richer_at(double value, int highest) {
  const auto go_on = [](const solver::ResponsePoint&) {
    return !interrupt_requested() && !cut_short();
  };
  ReducedModel richer = model_;
  richer.effects.n_harmonics = highest;
  Factors more;
  more.n_harmonics = highest;
  solver::ContinuationOptions range = continuation_options(scene_, model_);
  range.judge_stability = false;
  try {
    const solver::ResponseCurve curve = solver::trace_response(scene_at(value, {}), range, go_on);
    if (interrupt_requested() || cut_short()) return std::nullopt;
    return solver::richer_peak(scene_at(value, more), continuation_options(scene_, richer), curve,
                               highest);
  } catch (const RefusedError&) {  // a neighbour that the search need not have visited
    return std::nullopt;
  }
}

std::string OptimumSearch::left_out(const solver::Optimum& optimum) {
  constexpr double worth_a_word = 0.02;
  if (!optimum.found) return {};
  const solver::PeakOfParameter& best = optimum.best;
  const int highest = harmonics_to_check(model_, scene_);
  if (highest == 0) return {};
  const auto here = richer_at(best.parameter, highest);
  if (!here || (here->change && std::abs(*here->change) < worth_a_word)) return {};
  // Where the lowest of a few neighbours lies tells which way the best value moves.
  std::string lowest = "not found";
  double least = std::numeric_limits<double>::infinity();
  constexpr std::array factors{0.7, 0.84, 1.19, 1.42};
  std::array<std::optional<solver::RicherPeak>, factors.size()> neighbours;
  in_parallel(factors.size(), jobs_, [&](std::size_t i) {
    const double value = factors[i] * best.parameter;
    const bool inside = value >= options_.lower && value <= options_.upper;
    if (value != best.parameter && inside) neighbours[i] = richer_at(value, highest);
  });
  const auto look_at = [&](double value, const std::optional<solver::RicherPeak>& there) {
    if (!there || !there->change || there->amplitude >= least) return;
    least = there->amplitude;
    lowest = fmt::format("{:.2g} m at {} {:.3g}", least, request_.key, value);
  };
  look_at(best.parameter, here);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    look_at(factors[i] * best.parameter, neighbours[i]);
  }
  const std::string peak = here->change
                               ? fmt::format("{:.2g} m, {:+.0f} %", here->amplitude,
                                             100.0 * (here->amplitude / best.amplitude - 1.0))
                               : "not found from there";
  return fmt::format(
      "with harmonics up to {} the peak at the best value is {}; of 0.7 to 1.4 times this value "
      "the lowest is {}: "
      "set response.harmonics = {} or \"auto\"",
      highest, peak, lowest, highest);
}

/// What is left out is told in the bracket.
std::vector<OptimumSearch::Change> OptimumSearch::changes(OptimumBracket& bracket) const {
  const auto varies = [&](const char* parameter, const char* searched, std::string obstacle) {
    const std::string_view key = request_.key;
    if (key.starts_with("contact") && key.find(searched) != key.npos) {
      obstacle = fmt::format("{} is the number that is searched", key);
    }
    if (!obstacle.empty()) bracket.left_out.push_back(fmt::format("{}: {}", parameter, obstacle));
    return obstacle.empty();
  };
  constexpr const char* stiffness = "contact_stiffness";
  const bool friction_varies = varies(friction, "friction", no_friction_factor(model_));
  const bool stiffness_varies =
      varies(stiffness, "_stiffness", no_stiffness_factor(model_, scene_));
  std::vector<Change> list;
  const int n = bracket_by_few() ? few_harmonics : 0;
  for (const double factor : {0.5, 2.0}) {
    if (friction_varies) list.push_back({friction, factor, {factor, 1.0, n}});
    if (stiffness_varies) list.push_back({stiffness, factor, {1.0, factor, n}});
  }
  return list;
}

void OptimumSearch::complete(OptimumBracket& bracket) {
  const bool varies = std::ranges::any_of(bracket.entries, [](const OptimumOfFactor& entry) {
    return std::string_view(entry.parameter) == friction;
  });
  if (!bracket_by_few() || !varies || cut_short()) return;
  const Factors as_given{1.0, 1.0, few_harmonics};
  solver::Optimum optimum;
  try {
    optimum = by_few_ ? *by_few_ : search(as_given, jobs_);
  } catch (const RefusedError& error) {
    bracket.left_out.push_back(fmt::format("{} x 1: {}", friction, error.what()));
    return;
  }
  if (by_few_) tell_remedy(remedy_of(optimum.reason), optimum);
  bracket.entries.insert(
      bracket.entries.begin(),
      {friction, 1.0, std::move(optimum), {options_.lower, options_.upper}, false, few_harmonics});
}

bool OptimumSearch::bracket_by_few() const { return has_short_search(scene_); }

OptimumBracket OptimumSearch::bracket(int jobs) {
  OptimumBracket bracket;
  const std::vector<Change> list = changes(bracket);
  std::vector<std::optional<solver::Optimum>> found(list.size());
  std::vector<std::string> refused(list.size());
  in_parallel(list.size(), std::min(jobs, jobs_), [&](std::size_t i) {
    try {
      found[i] = search(list[i].factors, 1);
    } catch (const RefusedError& error) {
      refused[i] = error.what();
    }
  });
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& [parameter, factor, factors] = list[i];
    if (!found[i]) {
      bracket.left_out.push_back(fmt::format("{} x {:g}: {}", parameter, factor, refused[i]));
      continue;
    }
    const solver::OptimumOptions options = options_for(factors);
    const bool widened = options.lower < options_.lower || options.upper > options_.upper;
    bracket.entries.push_back({parameter,
                               factor,
                               std::move(*found[i]),
                               {options.lower, options.upper},
                               widened,
                               factors.n_harmonics});
  }
  return bracket;
}

}  // namespace microslip::pipelines
