#include "pipelines/accuracy/error_budget.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "pipelines/accuracy/errors_in_time.hpp"
#include "pipelines/accuracy/with_effect.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/response/peak_about.hpp"
#include "pipelines/response/resonating_shapes.hpp"
#include "pipelines/response/response_stage.hpp"
#include "pipelines/response/sampled_curve.hpp"
#include "pipelines/response/solver_scenes.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/text/rounded.hpp"
#include "solver/point_shift.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {
namespace {

constexpr const char* amplitude = peak_amplitude_goal;
constexpr const char* frequency = peak_frequency_goal;
constexpr const char* energy = dissipated_energy_goal;
// Of what a period takes from the excitation: less is not told from what Newton's method leaves.
constexpr double least_dissipated = 1e-6;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What one source does to the goals, relative.
struct GoalEffects {
  double amplitude = 0.0;
  double frequency = 0.0;
  double energy = 0.0;  ///< without a meaning where friction dissipates nothing
};

void add_rows(CurveBudget& budget, const std::string& curve, const std::string& source,
              const GoalEffects& effects, ErrorKind kind, double seconds) {
  budget.rows.push_back({curve, amplitude, source, effects.amplitude, kind, seconds});
  budget.rows.push_back({curve, frequency, source, effects.frequency, kind, seconds});
  if (!budget.energy_ratio) return;
  budget.rows.push_back({curve, energy, source, effects.energy, kind, seconds});
}

/// Of amplitude, frequency and energy from one peak to another.
GoalEffects changes(const CurveBudget& budget, const solver::ResponsePoint& peak,
                    const GoalEffects& other) {
  return {other.amplitude / peak.amplitude - 1.0, other.frequency / peak.frequency - 1.0,
          budget.energy_ratio ? other.energy / budget.dissipated_energy - 1.0 : 0.0};
}

/// The same, where only the amplitude's is known, or what energy lacks of all that is exchanged.
GoalEffects of_amplitude_alone(const CurveBudget& budget, double effect) {
  return {effect, 0.0, budget.energy_ratio.value_or(0.0) * effect};
}

void add_energy(CurveBudget& budget, const solver::ResponsePoint& peak) {
  const double taken = peak.energy.friction + peak.energy.damping;
  budget.dissipated_energy = peak.energy.friction;
  if (peak.energy.friction > least_dissipated * taken) {
    budget.energy_ratio = taken / peak.energy.friction;
  }
}

/// Changes of a peak that are a small part of its bar: one step in the richer model tells them. Not
/// those of another mesh, whose modes are others: a step told a fifth of one of 1 %.
double told_by_step(const SceneDescription& scene, const RicherModel& richer) {
  constexpr double of_tolerance = 0.05;
  constexpr double without = 1e-3;
  if (richer.source == "mesh") return 0.0;
  return scene.accuracy.tolerance > 0.0 ? of_tolerance * scene.accuracy.tolerance : without;
}

struct PeakThere {
  GoalEffects goals;  ///< amplitude [m], frequency [rad/s], energy [J]
  ErrorKind kind = ErrorKind::solved;
};

/// Newton's method from the peak of a curve does not always lead to that on another mesh, whose
/// resonances lie elsewhere: its own curve is traced there, at the price of the curve itself.
bool is_worth_a_trace(const SceneDescription& scene, const RicherModel& richer) {
  return richer.source == "mesh" && scene.accuracy.tolerance > 0.0 && !is_single_frequency(scene);
}

/// The peak of a limit in another model, which may have left the range; where there is none but the
/// range's end, the amplitude there.
const solver::ResponsePoint* nearest_to(double place, solver::PointMark mark,
                                        const solver::ResponseCurve& curve) {
  const solver::ResponsePoint* nearest = nullptr;
  for (const solver::ResponsePoint& point : curve.points) {
    if (mark == solver::PointMark::peak && point.mark != mark) continue;
    const double distance = std::abs(point.frequency - place);
    if (nearest == nullptr || distance < std::abs(nearest->frequency - place)) nearest = &point;
  }
  return nearest;
}

SceneDescription with_wider_range(SceneDescription scene) {
  constexpr double beyond = 0.1;
  ResponseDescription& response = *scene.response;
  const auto [low, high] = response.frequency_begin_hz < response.frequency_end_hz
                               ? std::tie(response.frequency_begin_hz, response.frequency_end_hz)
                               : std::tie(response.frequency_end_hz, response.frequency_begin_hz);
  low *= 1.0 - beyond;
  high *= 1.0 + beyond;
  return scene;
}

/// The highest peak of a linear limit in another model.
std::optional<PeakThere> limit_peak_there(const ReducedModel& own, const SceneDescription& scene,
                                          const RicherModel& richer,
                                          const solver::ResponsePoint& peak, LimitName limit) {
  const bool is_peak = peak.mark == solver::PointMark::peak;
  const solver::ResponseCurve curve =
      limit_curve(richer.model, is_peak ? with_wider_range(scene) : scene, limit);
  const double factor =
      is_peak ? frequency_factor(own, richer.model, peak.frequency, richer.embedding) : 1.0;
  const auto* there = nearest_to(factor * peak.frequency, peak.mark, curve);
  if (there == nullptr) return std::nullopt;
  return PeakThere{{there->amplitude, there->frequency}};
}

/// The limit that a curve is proved to be; empty: none.
std::optional<LimitName> limit_of(const solver::ResponseCurve& curve) {
  const contact::CycleReport& share = highest_peak(curve)->report;
  if (curve.certificate.empty()) return std::nullopt;
  if (share.stick_share == 1.0) return LimitName::stuck;
  return share.separated_share == 1.0 ? std::optional(LimitName::free) : std::nullopt;
}

PeakThere of_point(const solver::ResponsePoint& peak) {
  return {{peak.amplitude, peak.frequency, peak.energy.friction}};
}

/// The highest peak of the curve in another model.
std::optional<PeakThere> peak_there(const ReducedModel& own, const SceneDescription& scene,
                                    const RicherModel& richer, const solver::ResponseCurve& curve,
                                    double load) {
  ReducedModel refined = richer.model;
  refined.effects.located = refined.effects.located || own.effects.located;
  const solver::ContinuationOptions options = options_of_both(scene, own, refined);
  const solver::Scene here = solver_scene(own, load);
  const solver::Scene there = solver_scene(refined, load);
  const solver::ResponsePoint& top = *highest_peak(curve);
  const double factor = frequency_factor(own, richer.model, top.frequency, richer.embedding);
  const solver::OtherModel other{there, richer.embedding, factor, told_by_step(scene, richer)};
  if (const auto peak = solver::peak_elsewhere(here, options, curve, other)) {
    if (richer.source == "second_direction") {  // it may drive a mode that nothing else drives
      const double above = std::max(peak->other_amplitude, top.amplitude);
      const auto higher =
          peak_only_with(here, other, options, curve, above, seconds_of_trace(scene));
      if (higher) return of_point(*higher);
    }
    return PeakThere{{peak->other_amplitude, peak->other_frequency, peak->other_dissipated_energy},
                     peak->is_solved ? ErrorKind::solved : ErrorKind::estimated};
  }
  if (const auto limit = limit_of(curve)) return limit_peak_there(own, scene, richer, top, *limit);
  if (!is_worth_a_trace(scene, richer)) return std::nullopt;
  const auto traced = peak_about(refined, load, solver::with_harmonics_of(here, options, curve),
                                 factor * top.frequency);
  if (!traced) return std::nullopt;
  return of_point(*traced);
}

void add_model(CurveBudget& budget, const ReducedModel& model, const SceneDescription& scene,
               const RicherModel& richer, const CurveResult& result, double load) {
  const auto begin = std::chrono::steady_clock::now();
  const auto peak = peak_there(model_of(model, result.curve), scene, richer, result.curve, load);
  if (!peak || !(peak->goals.amplitude > 0.0)) {
    budget.unknown.push_back(richer.source);
    return;
  }
  const GoalEffects change = changes(budget, *highest_peak(result.curve), peak->goals);
  add_rows(budget, result.name, richer.source,
           {richer.share * change.amplitude, richer.share * change.frequency,
            richer.share * change.energy},
           peak->kind, seconds_since(begin));
}

/// What located events move the peaks and folds of a curve by: the largest of all. No row where one
/// of them is not told.
void add_marks(CurveBudget& budget, const ReducedModel& model, const RicherModel& located,
               const CurveResult& result, double load) {
  const auto begin = std::chrono::steady_clock::now();
  ReducedModel exact = model_of(model, result.curve);
  if (exact.effects.located) return;
  exact.effects.located = true;
  const solver::Scene scene = solver_scene(exact, load);
  solver::PointShift largest;
  const auto keep = [](double& most, double other) {
    if (std::abs(other) > std::abs(most)) most = other;
  };
  bool has_marks = false;
  for (const solver::ResponsePoint& point : result.curve.points) {
    const bool peak = point.mark == solver::PointMark::peak;
    if (!peak && point.mark != solver::PointMark::fold) continue;
    const auto shift = solver::point_shift(scene, point);
    if (!shift) return;
    has_marks = true;
    keep(largest.frequency, shift->frequency);
    if (peak) keep(largest.amplitude, shift->amplitude);
  }
  if (!has_marks) return;
  const double seconds = seconds_since(begin);
  const std::string& source = located.source;
  budget.rows.push_back({result.name, marked_amplitude_goal, source, largest.amplitude,
                         ErrorKind::estimated, seconds});
  budget.rows.push_back({result.name, marked_frequency_goal, source, largest.frequency,
                         ErrorKind::estimated, seconds});
}

/// From the peak to that with more harmonics, and away from it by what these leave out.
GoalEffects of_more_harmonics(const CurveBudget& budget, const solver::ResponsePoint& peak,
                              const GoalEffects& with_more, double left_out) {
  GoalEffects change = changes(budget, peak, with_more);
  const GoalEffects beyond = of_amplitude_alone(budget, left_out);
  change.amplitude += std::copysign(beyond.amplitude, change.amplitude);
  change.energy += std::copysign(beyond.energy, change.energy);
  return change;
}

/// Given harmonics have been solved with more; of chosen ones the peak knows what is left out.
/// @param is_told  the curve was solved with chosen harmonics,
///                 or more of them are known to do nothing.
void add_harmonics(CurveBudget& budget, const CurveResult& result,
                   const solver::ResponsePoint& peak, bool is_told) {
  const solver::SettledPeak& settled = result.curve.settled_peak;
  const bool is_open =  // another place may be highest than the one that was asked
      is_unsettled(result.curve) && peak.harmonics_left_out >= solver::all_left_out;
  if (!result.richer && is_open) {
    budget.unknown.emplace_back("harmonics");
  } else if (!result.richer && settled.amplitude > 0.0) {
    add_rows(budget, result.name, "harmonics",
             of_more_harmonics(budget, peak,
                               {settled.amplitude, settled.frequency, settled.dissipated_energy},
                               settled.left_out),
             ErrorKind::solved, 0.0);
  } else if (!result.richer && !is_told) {
    budget.unknown.emplace_back("harmonics");
  } else if (!result.richer && !is_left_out_known(result.curve, peak.harmonics_left_out)) {
    budget.unknown.emplace_back("harmonics");
  } else if (!result.richer) {
    add_rows(budget, result.name, "harmonics", of_amplitude_alone(budget, peak.harmonics_left_out),
             ErrorKind::estimated, 0.0);
  } else if (result.richer->change) {
    const solver::RicherPeak& richer = *result.richer;
    add_rows(budget, result.name, "harmonics",
             of_more_harmonics(budget, peak,
                               {richer.amplitude, richer.frequency, richer.dissipated_energy},
                               richer.left_out),
             ErrorKind::solved, richer.seconds);
  } else {
    budget.unknown.emplace_back("harmonics");
  }
}

/// How far Newton's method went: the balance of energy of the peak.
void add_certificate(CurveBudget& budget, const CurveResult& result,
                     const solver::ResponsePoint& peak) {
  add_rows(budget, result.name, "newton", of_amplitude_alone(budget, peak.energy_imbalance),
           ErrorKind::estimated, 0.0);
}

/// By what is left of the equations of the mode nearest to the peak, relative: an eigenvalue errs
/// by about as much, and so does a shape where no other eigenvalue is near.
void add_eigensolver(CurveBudget& budget, const ReducedModel& model, const RicherModels& richer,
                     const std::string& curve, const solver::ResponsePoint& peak) {
  const Eigen::Index n = std::min(richer.eigen_residual.size(), model.frequency.size());
  if (n == 0) return;
  Eigen::Index nearest = 0;
  (model.frequency.head(n).array() - peak.frequency).abs().minCoeff(&nearest);
  const double left = richer.eigen_residual[nearest];
  GoalEffects effects = of_amplitude_alone(budget, left);
  effects.frequency = 0.5 * left;
  add_rows(budget, curve, "eigensolver", effects, ErrorKind::estimated, 0.0);
}

/// Of a free structure the contact has no part.
bool concerns(const RicherModel& richer, LimitName limit) {
  if (richer.source == "instants") return false;
  return limit == LimitName::stuck || richer.source == "mesh" || richer.source == "basis";
}

/// Of a linear limit: its highest peak in every model.
CurveBudget limit_budget(const ReducedModel& model, const SceneDescription& scene,
                         const RicherModels& richer, const CurveResult& result, LimitName limit) {
  CurveBudget budget;
  budget.touches = limit == LimitName::stuck;
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  // What elements do outweighs all else: without it nothing is told.
  const bool is_mesh_known =
      std::ranges::find(richer.models, "mesh", &RicherModel::source) != richer.models.end();
  if (peak == nullptr || !(peak->amplitude > 0.0) || !is_mesh_known) return budget;
  for (const RicherModel& other : richer.models) {
    if (!concerns(other, limit)) continue;
    const auto begin = std::chrono::steady_clock::now();
    const auto there = limit_peak_there(model, scene, other, *peak, limit);
    if (!there) {
      budget.unknown.push_back(other.source);
      continue;
    }
    const GoalEffects change = changes(budget, *peak, there->goals);
    add_rows(budget, result.name, other.source,
             {other.share * change.amplitude, other.share * change.frequency}, ErrorKind::solved,
             seconds_since(begin));
  }
  for (const std::string& source : richer.unknown) {
    if (concerns({source, {}}, limit)) budget.unknown.push_back(source);
  }
  add_eigensolver(budget, model, richer, result.name, *peak);
  return budget;
}

std::string energy_text(const CurveBudget& budget, const std::string& curve) {
  if (!budget.energy_ratio) return "friction dissipates nothing there";
  const double bar = bar_of(budget.rows, curve, energy);
  if (bar > 1.0) return "dissipated energy ± more than all of it";
  return "dissipated energy ± " + percent_text(bar);
}

/// Of one source and goal, over all curves that know it. What the contact errs by is told by those
/// that it has a part in.
const ErrorRow* largest_row(const std::vector<CurveBudget>& budgets, const std::string& source,
                            const char* goal) {
  const ErrorRow* largest = nullptr;
  for (const CurveBudget& budget : budgets) {
    if (!budget.touches && source != "mesh") continue;
    for (const ErrorRow& row : budget.rows) {
      const bool told = row.source == source && row.goal == goal && row.kind != ErrorKind::borrowed;
      if (told && (largest == nullptr || std::abs(row.effect) > std::abs(largest->effect))) {
        largest = &row;
      }
    }
  }
  return largest;
}

}  // namespace

CurveBudget with_harmonics_of(CurveBudget before, const CurveBudget& now) {
  before.along = now.along;
  constexpr const char* harmonics = "harmonics";
  const auto are_told = [](const ErrorRow& row) { return row.source == harmonics; };
  std::erase_if(before.rows, are_told);
  std::ranges::copy_if(now.rows, std::back_inserter(before.rows), are_told);
  std::erase(before.unknown, harmonics);
  if (std::ranges::find(now.unknown, harmonics) != now.unknown.end()) {
    before.unknown.emplace_back(harmonics);
  }
  before.dissipated_energy = now.dissipated_energy;
  before.energy_ratio = now.energy_ratio;
  return before;
}

void borrow_unknown(std::vector<CurveBudget>& budgets) {
  for (CurveBudget& budget : budgets) {
    if (budget.rows.empty() || !budget.has_bar()) continue;
    const std::string curve = budget.rows.front().curve;
    std::erase_if(budget.unknown, [&](const std::string& source) {
      const ErrorRow* of_amplitude = largest_row(budgets, source, amplitude);
      const ErrorRow* of_frequency = largest_row(budgets, source, frequency);
      if (of_amplitude == nullptr || of_frequency == nullptr) return false;
      const ErrorRow* of_energy = largest_row(budgets, source, energy);
      GoalEffects borrowed = of_amplitude_alone(budget, of_amplitude->effect);
      borrowed.frequency = of_frequency->effect;
      if (of_energy != nullptr) borrowed.energy = of_energy->effect;
      add_rows(budget, curve, source, borrowed, ErrorKind::borrowed, 0.0);
      return true;
    });
  }
}

bool CurveBudget::has_bar() const {
  return !rows.empty() && std::ranges::find(unknown, "harmonics") == unknown.end();
}

namespace {

/// Contact that opens and closes drives harmonics beyond the modes kept, which are not asked what
/// they do (harmonics.md).
bool leaves_modes_out(const ReducedModel& model, const SceneDescription& scene,
                      const CurveResult& result) {
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  return harmonics.chosen() && result.curve.certificate.empty() &&
         continuation_options(scene, model).n_harmonics < harmonics.highest &&
         opens_and_closes(result.curve);
}

/// What is not told of a motion integrated in time: the models that could are not integrated.
std::vector<std::string> unknown_in_time(const SceneDescription& scene,
                                         const RicherModels& richer) {
  std::vector<std::string> sources = richer.unknown;
  for (const RicherModel& other : richer.models) {
    if (other.source != "instants") sources.push_back(other.source);
  }
  const bool meshed = !std::holds_alternative<ModalModel>(scene.model);
  if (sources.empty() && meshed) sources = {"mesh", "basis", "cells", "fit"};
  return sources;
}

/// Of a motion integrated in time.
CurveBudget budget_in_time(const ReducedModel& model, const SceneDescription& scene,
                           const RicherModels& richer, const CurveResult& result, double load) {
  CurveBudget budget;
  budget.unknown = unknown_in_time(scene, richer);
  const solver::ResponsePoint& largest = *highest_peak(result.curve);
  add_energy(budget, largest);
  const auto begin = std::chrono::steady_clock::now();
  if (const auto closer = integrated_with_events(model, scene, result, load)) {
    add_rows(
        budget, result.name, "steps",
        changes(budget, largest, {closer->amplitude, largest.frequency, closer->energy.friction}),
        ErrorKind::solved, seconds_since(begin));
  } else {
    budget.unknown.emplace_back("steps");
  }
  if (result.curve.points.size() == 1) return budget;  // the motion at that frequency
  // Of a sweep that ended early the largest motion need not be there.
  const auto top = result.curve.complete ? top_between(result.curve) : std::nullopt;
  if (top) {
    GoalEffects all = of_amplitude_alone(budget, top->amplitude);
    all.frequency = top->frequency;
    add_rows(budget, result.name, "frequencies", all, ErrorKind::estimated, 0.0);
  } else {
    budget.unknown.emplace_back("frequencies");
  }
  return budget;
}

}  // namespace

CurveBudget error_budget(const ReducedModel& model, const SceneDescription& scene,
                         const RicherModels& richer, const CurveResult& result) {
  if (const auto* limit = std::get_if<LimitName>(&result.load)) {
    return limit_budget(model, scene, richer, result, *limit);
  }
  CurveBudget budget;
  const auto* load = std::get_if<double>(&result.load);
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (peak == nullptr || !(peak->amplitude > 0.0)) return budget;
  if (result.integrated) return budget_in_time(model, scene, richer, result, *load);
  if (!result.curve.complete) {  // its highest peak need not be there
    budget.unknown = richer.unknown;
    budget.unknown.emplace_back("harmonics");
    return budget;
  }
  budget.unknown = richer.unknown;
  budget.touches = peak->report.separated_share < 1.0;
  add_energy(budget, *peak);
  const bool is_told = scene.settings.harmonics.chosen() || !result.curve.certificate.empty();
  add_harmonics(budget, result, *peak, is_told);
  for (const RicherModel& other : richer.models) {
    if (cut_short()) {
      budget.unknown.push_back(other.source);
      continue;
    }
    add_model(budget, model, scene, other, result, *load);
    if (other.source == "instants") add_marks(budget, model, other, result, *load);
  }
  if (leaves_modes_out(model, scene, result)) budget.unknown.emplace_back("modes");
  add_eigensolver(budget, model, richer, result.name, *peak);
  add_certificate(budget, result, *peak);
  return budget;
}

std::vector<solver::PointShift> harmonics_along(ReducedModel model, const SceneDescription& scene,
                                                const CurveResult& result) {
  const auto* load = std::get_if<double>(&result.load);
  if (load == nullptr || result.integrated) return {};
  const HarmonicSettings& harmonics = scene.settings.harmonics;
  const int highest = harmonics.chosen() ? continuation_options(scene, model).n_harmonics
                                         : harmonics.highest + harmonics_of_a_check;
  model.effects.n_harmonics = std::max(model.effects.n_harmonics, highest);
  model = model_of(std::move(model), result.curve);
  return solver::shifts_along(solver_scene(model, *load), result.curve, highest,
                              [] { return cut_short(); });
}

std::string budget_text(const CurveBudget& budget) {
  if (budget.rows.empty()) return {};
  const std::string& curve = budget.rows.front().curve;
  std::vector<ErrorRow> parts;
  for (const ErrorRow& row : budget.rows) {
    if (row.goal == amplitude) parts.push_back(row);
  }
  std::ranges::stable_sort(parts, [](const ErrorRow& a, const ErrorRow& b) {
    return std::abs(a.effect) > std::abs(b.effect);
  });
  if (!budget.has_bar()) {
    return fmt::format("curve {}: its error is not known: what more harmonics do was not found",
                       curve);
  }
  std::string text =
      fmt::format("curve {}: peak ± {}, its frequency ± {}, {}:", curve,
                  percent_text(bar_of(budget.rows, curve, amplitude)),
                  percent_text(bar_of(budget.rows, curve, frequency)), energy_text(budget, curve));
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, parts.size()); ++i) {
    text += fmt::format("{} {} {}", i > 0 ? "," : "", parts[i].source,
                        signed_percent_text(parts[i].effect));
    if (parts[i].kind == ErrorKind::borrowed) text += " (as of another curve)";
  }
  if (!budget.unknown.empty()) {
    text += fmt::format("; not known: {}", fmt::join(budget.unknown, ", "));
  }
  return text;
}

}  // namespace microslip::pipelines
