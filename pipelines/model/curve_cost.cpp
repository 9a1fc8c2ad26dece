#include "pipelines/model/curve_cost.hpp"

#include <algorithm>
#include <variant>

#include "pipelines/scene/curve_request.hpp"

namespace microslip::pipelines {
namespace {

// Curves' worth of work: the search itself and the four of its bracket.
constexpr double searches_of_an_optimum = 5 * 6.0;

// One point in one iteration [s]: medians of the benchmarks, doubled for the rest of an iteration.
constexpr double closed_form_cost = 1.4e-6;
constexpr double event_cost = 1e-5;
constexpr double planar_cost = 1.5e-4;
constexpr double chosen_cost =
    5e-4;  // harmonics = "auto" where the blade slips: some fifteen of them
constexpr double iterations_per_curve = 350.0;
constexpr double iterations_per_start = 20.0;
constexpr double frequencies_of_a_search = 14.0;  // of a range (solver/curve/branch_search.hpp)

double iteration_seconds(const SceneDescription& scene, const PointMethod& method) {
  const auto* modal = std::get_if<ModalModel>(&scene.model);
  double n_points = modal != nullptr ? static_cast<double>(modal->points.size()) : 0.0;
  for (std::size_t i = 0; i < scene.settings.patches.size(); ++i) {
    n_points += contact_points(scene.settings, i);
  }
  const bool simple = !method.several_harmonics && !is_rate_dependent(scene) && !is_rough(scene);
  const double of_method = method.second_direction ? planar_cost
                           : simple                ? closed_form_cost
                                                   : event_cost;
  return n_points * (method.chosen_harmonics ? std::max(chosen_cost, of_method) : of_method);
}

double n_curves(const SceneDescription& scene) {
  const double searches = scene.response->optimum ? searches_of_an_optimum : 0.0;
  return static_cast<double>(curve_requests(scene).size()) + searches;
}

}  // namespace

PointMethod method_of(const SceneDescription& scene, bool second_direction) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  return {second_direction, harmonics.highest > 1, harmonics.chosen()};
}

double curves_seconds(const SceneDescription& scene, const PointMethod& method) {
  return n_curves(scene) * iterations_per_curve * iteration_seconds(scene, method);
}

double search_seconds(const SceneDescription& scene, const PointMethod& method, int n_starts) {
  const bool one = scene.response->frequency_begin_hz == scene.response->frequency_end_hz;
  return n_curves(scene) * (one ? 1.0 : frequencies_of_a_search) * n_starts * iterations_per_start *
         iteration_seconds(scene, method);
}

}  // namespace microslip::pipelines
