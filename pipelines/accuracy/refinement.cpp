#include "pipelines/accuracy/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace microslip::pipelines {
namespace {

constexpr double wanted = 0.95;           // of the tolerance: estimates are no better
constexpr double closest_choice = 1e-5;   // of harmonics
constexpr double idle = 0.05;             // of the tolerance: not worth a refinement
constexpr double step_on_the_way = 0.15;  // of the error of harmonics
constexpr int most_points = 20000;        // of a patch
constexpr double finest_mesh = 0.25;      // of the element size at hand, at once
constexpr double least_refined = 0.85;    // likewise: less is not worth a mesh

/// Errors by source, the largest over the curves and both goals.
using Errors = std::map<std::string, double>;

Errors errors_of(const std::vector<CurveBudget>& budgets) {
  Errors errors;
  for (const CurveBudget& budget : budgets) {
    for (const ErrorRow& row : budget.rows) {
      double& largest = errors[row.source];
      largest = std::max(largest, std::abs(row.effect));
    }
    const bool lost = std::ranges::find(budget.unknown, "harmonics") != budget.unknown.end();
    if (lost) errors["harmonics"] = std::numeric_limits<double>::infinity();
  }
  return errors;
}

double sum(const Errors& errors) {
  double total = 0.0;
  for (const auto& [source, error] : errors) total += error;
  return total;
}

/// One source after the other, each at most once.
class Refiner {
 public:
  Refiner(const SceneDescription& scene, Errors errors, double tolerance)
      : given_(scene.settings), errors_(std::move(errors)), tolerance_(tolerance) {
    result_.scene = scene;
  }

  /// @return false: this source cannot be refined.
  bool refine(const std::string& source) {
    double& error = errors_.at(source);
    const bool meshed = !std::holds_alternative<ModalModel>(result_.scene.model);
    if (source == "harmonics") return choose_harmonics(error);
    if (source == "cells" && meshed) return add_cells(error);
    if (source == "fit" && meshed) return leave_out_fit(error);
    if (source == "second_direction") return add_direction(error);
    if (source == "mesh") return refine_mesh(error);
    return false;
  }

  [[nodiscard]] const Errors& errors() const { return errors_; }
  [[nodiscard]] Refinement result() {
    result_.text = fmt::format("{}", fmt::join(texts_, ", "));
    return result_;
  }

 private:
  bool choose_harmonics(double& error) {
    HarmonicSettings& harmonics = result_.scene.settings.harmonics;
    constexpr double anything = 1.0;
    const double before = harmonics.chosen() ? harmonics.tolerance : anything;
    double now = std::min(share_of_harmonics * tolerance_, 0.5 * before);
    // Where the time may run out a step on the way is worth its price.
    const bool hurried = std::isfinite(result_.scene.accuracy.budget) && std::isfinite(error);
    if (hurried) now = std::max(now, std::min(step_on_the_way * error, 0.5 * before));
    now = std::max(now, closest_choice);
    if (!(now < before)) return false;
    harmonics = {.highest = most_automatic_harmonics, .orders = {}, .tolerance = now};
    texts_.push_back(fmt::format("harmonics chosen to {:.2g} %", 100.0 * now));
    error = std::min(error, now);
    return true;
  }

  bool add_cells(double& error) {
    const double factor = std::clamp(2.0 * error / (0.25 * tolerance_), 4.0, 64.0);
    Discretisation& settings = result_.scene.settings;
    std::vector<int> points;
    for (std::size_t i = 0; i < settings.patches.size(); ++i) {
      points.push_back(static_cast<int>(factor * contact_points(given_, i)));
    }
    const int most = std::ranges::max(points);
    if (most > most_points) return false;
    for (std::size_t i = 0; i < points.size(); ++i) settings.patches[i].n_points = points[i];
    texts_.push_back(fmt::format("{} contact points at least", most));
    result_.factor *= factor;
    error /= factor;
    return true;
  }

  bool leave_out_fit(double& error) {
    for (PatchSettings& patch : result_.scene.settings.patches) {
      patch.fit = PatchSettings::Fit::none;
    }
    texts_.emplace_back("the elements' own shapes on the contact");
    error = 0.0;
    return true;
  }

  bool add_direction(double& error) {
    result_.scene.settings.second_direction = Discretisation::Choice::on;
    texts_.emplace_back("friction along both directions");
    result_.factor *= 3.0;
    error = 0.0;
    return true;
  }

  bool refine_mesh(double& error) {
    if (!element_size_of(result_.scene)) return false;
    const double factor =
        std::clamp(std::sqrt(0.4 * tolerance_ / error), finest_mesh, least_refined);
    result_.scene = with_elements_scaled(std::move(result_.scene), factor);
    result_.new_mesh = true;
    result_.factor /= factor * factor;
    texts_.push_back(fmt::format("elements of {:.3g} mm", 1e3 * *element_size_of(result_.scene)));
    error *= factor * factor;
    return true;
  }

  Refinement result_;
  Discretisation given_;  // what the errors are of
  Errors errors_;
  double tolerance_;
  std::vector<std::string> texts_;
};

}  // namespace

double largest_bar(const std::vector<CurveBudget>& budgets) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  bool any = false;
  for (const CurveBudget& budget : budgets) {
    if (budget.rows.empty() && budget.unknown.empty()) continue;  // a linear limit
    if (!budget.has_bar()) return none;
    any = true;
    for (const char* goal : {peak_amplitude_goal, peak_frequency_goal}) {
      largest = std::max(largest, bar_of(budget.rows, budget.rows.front().curve, goal));
    }
  }
  return any ? largest : none;
}

std::vector<std::string> not_in_bars(const std::vector<CurveBudget>& budgets) {
  std::set<std::string> names;
  for (const CurveBudget& budget : budgets) {
    names.insert(budget.unknown.begin(), budget.unknown.end());
  }
  return {names.begin(), names.end()};
}

std::optional<Refinement> refinement(const SceneDescription& scene,
                                     const std::vector<CurveBudget>& budgets, double tolerance,
                                     std::string& left) {
  const Errors errors = errors_of(budgets);
  std::vector<std::pair<double, std::string>> sources;  // the largest error first
  for (const auto& [source, error] : errors) sources.emplace_back(error, source);
  std::ranges::sort(sources, std::ranges::greater{});
  Refiner refiner(scene, errors, tolerance);
  bool any = false;
  std::vector<std::string> stuck;
  for (const auto& [error, source] : sources) {
    if (sum(refiner.errors()) <= wanted * tolerance || error <= idle * tolerance) break;
    if (refiner.refine(source)) {
      any = true;
      if (refiner.errors().at(source) > tolerance) break;  // a step on the way
    } else {
      stuck.push_back(source);
    }
  }
  left = fmt::format("{}", fmt::join(stuck, ", "));
  if (!any) return std::nullopt;
  return refiner.result();
}

}  // namespace microslip::pipelines
