#include "pipelines/accuracy/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/accuracy/bar_counts.hpp"
#include "pipelines/effects/effect_choice.hpp"
#include "pipelines/structure/extrapolated_modes.hpp"

namespace microslip::pipelines {
namespace {

constexpr double wanted = 0.9;            // of the tolerance: estimates are no better
constexpr double closest_choice = 1e-5;   // of harmonics
constexpr double step_on_the_way = 0.15;  // of the error of harmonics
constexpr double usual_error = 0.3;       // of one harmonic, where it could not be told
constexpr int most_points = 20000;        // of a patch
constexpr double worth_a_round = 0.9;     // of the bar: less is gained
constexpr double moves_away = 0.02;       // of harmonics: other errors were told at another peak
// Of the growth of the curves: a search solves few of them, and begins with few harmonics. Measured
// on the default blade from nine harmonics to those of 2 %: 33 to 72 s, curves 12 to 70.
constexpr double search_grows = 0.25;
// Of a mesh that does not tell it: elements of first order, which lock; others.
constexpr double usual_of_linear = 0.3;
constexpr double usual_of_mesh = 0.03;
constexpr double none = std::numeric_limits<double>::infinity();

/// One way to treat a source: what is left of its error, and what that costs.
struct Move {
  double factor = 1.0;     ///< of the error
  double most = none;      ///< or so much
  double structure = 0.0;  ///< time of mesh and modes, relative to that spent
  double curves = 1.0;     ///< … of the curves
  std::string text{};      ///< empty: as it is
  std::function<void(SceneDescription&)> apply = [](SceneDescription&) {};
};
using Moves = std::vector<Move>;

/// Errors of one goal of one curve by source.
using Errors = std::map<std::string, double>;

bool is_unknown(const CurveBudget& budget, const char* source) {
  return std::ranges::find(budget.unknown, source) != budget.unknown.end();
}

/// @param mesh  assumed where it is not known and could be.
std::vector<Errors> errors_of(const std::vector<CurveBudget>& budgets,
                              const std::vector<std::string>& goals, double mesh) {
  std::vector<Errors> all;
  for (const CurveBudget& budget : budgets) {
    for (const std::string& goal : goals) {
      Errors errors;
      for (const ErrorRow& row : budget.rows) {
        if (row.goal == goal) errors[row.source] += std::abs(row.effect);
      }
      if (is_unknown(budget, "harmonics")) errors["harmonics"] = none;
      if (mesh > 0.0 && is_unknown(budget, "mesh")) errors["mesh"] = mesh;
      if (!errors.empty()) all.push_back(std::move(errors));
    }
  }
  return all;
}

double largest_of(const std::vector<Errors>& all, const std::string& source) {
  double largest = 0.0;
  for (const Errors& errors : all) {
    const auto found = errors.find(source);
    if (found != errors.end()) largest = std::max(largest, found->second);
  }
  return largest;
}

/// The time of curves when their harmonics are chosen closer. Measured on the default blade: from 5
/// to 0.2 % 5.7 times as long, from 1 to 0.25 % 3.2 times.
double dearer(double tolerance, double closer) { return std::pow(tolerance / closer, 0.65); }

/// Chosen harmonics answer for a share of the tolerance. With a budget of time, which may run out,
/// a step on the way is worth its price.
Moves moves_of_harmonics(const SceneDescription& scene, double tolerance, double error) {
  const HarmonicSettings& given = scene.settings.harmonics;
  constexpr double anything = 1.0;
  const double before = given.chosen() ? given.tolerance : anything;
  double now = std::min(share_of_harmonics * tolerance, 0.5 * before);
  if (std::isfinite(scene.accuracy.budget)) {
    const double step = step_on_the_way * std::min(error, usual_error);
    now = std::max(now, std::min(step, 0.5 * before));
  }
  Moves moves;
  for (int halving = 0; halving < 3; ++halving, now *= 0.5) {
    const double choice = std::max(now, closest_choice);
    if (!(choice < before)) break;
    // A curve with one harmonic is a hundredth of one with those that matter.
    const double first = std::max(3.0, 40.0 / given.highest);
    const double price = given.chosen() ? dearer(before, choice)
                                        : first * dearer(share_of_harmonics * tolerance, choice);
    moves.push_back({.most = choice,
                     .curves = price,
                     .text = fmt::format("harmonics chosen to {:.2g} %", 100.0 * choice),
                     .apply = [choice](SceneDescription& finer) {
                       finer.settings.harmonics = automatic_harmonics(choice);
                     }});
  }
  return moves;
}

/// The error falls as the number of points grows.
Moves moves_of_cells(const SceneDescription& scene) {
  Moves moves;
  for (const double factor : {4.0, 16.0, 64.0}) {
    std::vector<int> points;
    for (std::size_t i = 0; i < scene.settings.patches.size(); ++i) {
      points.push_back(static_cast<int>(factor * contact_points(scene.settings, i)));
    }
    const int most = points.empty() ? 0 : std::ranges::max(points);
    if (most == 0 || most > most_points) break;
    moves.push_back({.factor = 1.0 / factor,
                     .curves = factor,
                     .text = fmt::format("{} contact points at least", most),
                     .apply = [points](SceneDescription& finer) {
                       for (std::size_t i = 0; i < points.size(); ++i) {
                         finer.settings.patches[i].n_points = points[i];
                       }
                     }});
  }
  return moves;
}

Moves moves_of_fit() {
  return {{.factor = 0.0,
           .text = "the elements' own shapes on the contact",
           .apply = [](SceneDescription& finer) {
             for (PatchSettings& patch : finer.settings.patches) {
               patch.fit = PatchSettings::Fit::none;
             }
           }}};
}

/// Measured on the default blade with chosen harmonics: 4 to 14 times the time.
Moves moves_of_second_direction() {
  return {{.factor = 0.0,
           .curves = 6.0,
           .text = "friction along both directions",
           .apply = [](SceneDescription& finer) {
             finer.settings.second_direction = Discretisation::Choice::on;
           }}};
}

/// Singular stresses at re-entrant edges make the error fall as the element size there alone
/// (theory 22). Measured on the default blade: elements of a share q of the others at these edges
/// leave 0.2 + 0.8 q of the error.
double left_with_edges(double share) { return 0.2 + 0.8 * share; }

/// Of the time of mesh and modes.
double price_of_edges(double share) { return share < 1.0 ? 1.0 + 0.1 / (share * share) : 1.0; }

constexpr double power_of_time = 3.3;  // of 1/size: mesh, factorisation, modes

std::string times_text(int n) {
  if (n == 1) return "once";
  return n == 2 ? "twice" : fmt::format("{} times", n);
}

/// Elements of a mesh file get midside nodes, if they have none, and are cut along each edge. Of
/// one cut there is no mesh twice as coarse again, and modes are not extrapolated. Measured on the
/// default blade of 10 mm: the first leaves 0.36 to 0.46 of what jumps of stress tell, both 0.03 to
/// 0.1; of its first frequency with four nodes a tetrahedron, 2.5 times too high, midside nodes
/// leave a hundredth of the error.
Moves moves_of_mesh_file(const SceneDescription& scene, const SpentSeconds& spent) {
  constexpr double times = 6.0;  // as many nodes: 4 of bricks, 7.5 of tetrahedra
  Moves moves;
  if (!is_mesh_refined_here(scene)) return moves;
  const bool linear = spent.linear_elements;
  const int now = std::get<MeshFileModel>(scene.model).refinement;
  const int most = std::min(most_cuts - now, spent.cuts_in_memory);
  for (int more = linear ? 0 : 1; more <= most; ++more) {
    const double size = std::ldexp(1.0, -more);
    const SceneDescription cut = with_elements_scaled(scene, size);
    std::string text =
        more == 0 ? "" : fmt::format("elements of the file cut {}", times_text(now + more));
    if (linear) text += fmt::format("{}midside nodes", more == 0 ? "" : ", with ");
    moves.push_back({.factor = (linear ? 0.1 : 1.0) * (is_extrapolated(cut) ? size * size : size),
                     .structure = (linear ? times : 1.0) * std::pow(size, -power_of_time),
                     .text = std::move(text),
                     .apply = [size, linear](SceneDescription& finer) {
                       finer = with_elements_scaled(std::move(finer), size);
                       if (linear) std::get<MeshFileModel>(finer.model).midside_nodes = true;
                     }});
  }
  return moves;
}

Moves moves_of_mesh(const SceneDescription& scene, const SpentSeconds& spent) {
  const std::optional<double> given = element_size_of(scene);
  if (!given) return moves_of_mesh_file(scene, spent);
  const auto* blade = std::get_if<BladeModel>(&scene.model);
  const double now =
      blade != nullptr ? std::min(1.0, blade->sizes.edge_size.value_or(*given) / *given) : 1.0;
  std::vector<double> shares{now};
  for (const double finer : {0.5, 0.33, 0.2}) {
    if (blade != nullptr && finer < 0.9 * now) shares.push_back(finer);
  }
  // Of extrapolated modes the next term is left, which falls an order faster; measured on the
  // default blade from 3 to 2 mm, and with edges of a fifth.
  const double order = spent.extrapolated ? 2.0 : 1.0;
  Moves moves;
  for (const double factor : {1.0, 0.85, 0.7, 0.6, 0.5, 0.35, 0.25}) {
    for (const double edges : shares) {
      if (edges == now && factor == 1.0) continue;
      const double size = factor * *given;
      const double left = std::pow(factor, order) * left_with_edges(edges) / left_with_edges(now);
      std::string text = fmt::format("elements of {:.3g} mm", 1e3 * size);
      if (edges < 1.0) text += fmt::format(", of {:.3g} mm at sharp edges", 1e3 * edges * size);
      moves.push_back({.factor = left,
                       .structure = price_of_edges(edges) / price_of_edges(now) *
                                    std::pow(factor, -power_of_time),
                       .text = std::move(text),
                       .apply = [factor, edges, now](SceneDescription& finer) {
                         finer = with_elements_scaled(std::move(finer), factor);
                         if (edges == now) return;
                         mesh::ElementSizes& sizes = std::get<BladeModel>(finer.model).sizes;
                         sizes.edge_size = edges * sizes.element_size;
                       }});
    }
  }
  return moves;
}

/// More contact points of a bar, or more modes, whose curves take as long as their square.
Moves moves_of_bar(const std::string& source, const SceneDescription& scene) {
  const std::optional<BarCounts> own = bar_counts(scene);
  if (!own) return {};
  constexpr int most_modes = 200;
  const bool points = source == "cells";
  Moves moves;
  for (const int times : {2, 4, 8, 16, 32}) {
    BarCounts more = *own;
    (points ? more.points : more.modes) *= times;
    if (more.points > most_points || more.modes > most_modes) break;
    const double factor = points ? left_with_points(times) : left_with_modes(scene, times);
    moves.push_back({.factor = factor,
                     .curves = points ? times : static_cast<double>(times) * times,
                     .text = points ? fmt::format("{} contact points", more.points)
                                    : fmt::format("{} modes", more.modes),
                     // Each of the two moves keeps what the other has done.
                     .apply = [points, more](SceneDescription& finer) {
                       BarCounts counts = *bar_counts(finer);
                       (points ? counts.points : counts.modes) = points ? more.points : more.modes;
                       finer = with_bar_counts(std::move(finer), counts);
                     }});
  }
  return moves;
}

Moves moves_of(const std::string& source, const SceneDescription& scene, double tolerance,
               double error, const SpentSeconds& spent) {
  const bool meshed = !std::holds_alternative<ModalModel>(scene.model);
  if (source == "harmonics") {
    if (setting_of(scene, "higher_harmonics") == "off") return {};
    return moves_of_harmonics(scene, tolerance, error);
  }
  if (source == "cells" && meshed) return moves_of_cells(scene);
  if (source == "cells" || source == "basis") return moves_of_bar(source, scene);
  if (source == "fit" && meshed) return moves_of_fit();
  if (source == "second_direction") return moves_of_second_direction();
  if (source == "mesh") return moves_of_mesh(scene, spent);
  return {};
}

/// One move of every source, and what comes of it.
struct Plan {
  std::map<std::string, const Move*> moves{};
  double seconds = none;  ///< of the round
  double structure_seconds = none;
  double curve_seconds = none;
  double until_end = none;  ///< by the clock
};

double bar_of(const Errors& errors) {
  double bar = 0.0;
  for (const auto& [source, error] : errors) bar += error;
  return bar;
}

/// Where harmonics change a peak by more than some per cent, the error of the mesh was told at a
/// peak that moves. Measured on the default blade: 2.3 and 1.0 % with nine harmonics are 6.3 and
/// 5.5 % with those that are needed; of extrapolated modes what was told stays.
/// @param are_refined  the harmonics.
/// @param doubt        the factor, as doubt_of() what was solved.
double growth(const std::string& source, const Errors& errors, bool are_refined, double doubt) {
  const auto harmonics = errors.find("harmonics");
  const bool moves = are_refined && harmonics != errors.end() && harmonics->second > moves_away;
  return source == "mesh" && moves ? doubt : 1.0;
}

double doubt_of(const SpentSeconds& spent) { return spent.extrapolated ? 1.0 : 3.0; }

double bar_after(const Errors& errors, const Plan& plan, double doubt) {
  const auto harmonics = plan.moves.find("harmonics");
  const bool refined = harmonics != plan.moves.end() && !harmonics->second->text.empty();
  double bar = 0.0;
  for (const auto& [source, error] : errors) {
    const Move& move = *plan.moves.at(source);
    bar += std::min(growth(source, errors, refined, doubt) * error * move.factor, move.most);
  }
  return bar;
}

/// Some bar that is above the tolerance becomes smaller by what is worth a round.
bool gains(const Plan& plan, const std::vector<Errors>& errors, double tolerance, double doubt) {
  return std::ranges::any_of(errors, [&](const Errors& one) {
    const double before = bar_of(one);
    return before > tolerance && bar_after(one, plan, doubt) < worth_a_round * before;
  });
}

/// Every combination of moves; the cheapest that is enough.
class Plans {
 public:
  Plans(const std::vector<Errors>& errors, const std::map<std::string, Moves>& moves,
        const SpentSeconds& spent, double tolerance)
      : errors_(errors), spent_(spent), tolerance_(tolerance), doubt_(doubt_of(spent)) {
    for (const auto& [source, own] : moves) sources_.emplace_back(source, &own);
    // Where what cannot be refined is above the tolerance, what can be is brought below it.
    constexpr double beside = 0.5;  // of the tolerance
    // Large errors are rough ones: to go all the way at once is to go too far, and a finer mesh or
    // friction along r for nothing costs more than a round. What moves is left to the next one.
    constexpr double ambition = 4.0;
    double rough = 0.0;
    for (const Errors& one : errors) {
      const double bar = bar_of(one);
      if (!std::isfinite(bar)) continue;
      rough = std::max(rough, (bar - least_of(one, moves, doubt_)) / ambition);
    }
    for (const Errors& one : errors) {
      bounds_.push_back(
          std::max({wanted * tolerance, least_of(one, moves, doubt_) + beside * tolerance, rough}));
    }
    extend({}, 0);
  }

  /// The cheapest that is enough; where there is no time for it, the one that leaves least, if that
  /// is worth a round.
  [[nodiscard]] const Plan& best() const {
    const bool has_time = cheapest_.until_end <= spent_.available;
    const bool has_other =
        !affordable_.moves.empty() && gains(affordable_, errors_, tolerance_, doubt_);
    return has_time || !has_other ? cheapest_ : affordable_;
  }

 private:
  static double least_of(const Errors& errors, const std::map<std::string, Moves>& moves,
                         double doubt) {
    const auto harmonics = moves.find("harmonics");
    const bool refined = harmonics != moves.end() && harmonics->second.size() > 1;
    double bar = 0.0;
    for (const auto& [source, error] : errors) {
      const double grown = growth(source, errors, refined, doubt) * error;
      double least = none;
      for (const Move& move : moves.at(source)) {
        least = std::min({least, grown * move.factor, move.most});
      }
      bar += least;
    }
    return bar;
  }

  void extend(Plan plan, std::size_t i) {
    if (i == sources_.size()) {
      judge(std::move(plan));
      return;
    }
    for (const Move& move : *sources_[i].second) {
      plan.moves[sources_[i].first] = &move;
      extend(plan, i + 1);
    }
  }

  void judge(Plan plan) {
    double structure = 0.0;
    double curves = 1.0;
    for (const auto& [source, move] : plan.moves) {
      structure += move->structure;
      curves *= move->curves;
    }
    const bool only_harmonics = std::ranges::all_of(plan.moves, [](const auto& one) {
      return one.first == "harmonics" || one.second->text.empty();
    });
    const double again =
        only_harmonics ? spent_.inexact_curves.value_or(spent_.curves) : spent_.curves;
    const double errors =
        only_harmonics ? spent_.inexact_errors.value_or(spent_.errors) : spent_.errors;
    plan.structure_seconds = structure * spent_.structure;
    plan.curve_seconds = curves * again;
    const double told = plan.curve_seconds + curves * errors;
    plan.seconds = plan.structure_seconds + told;
    const double search = 1.0 + search_grows * (curves - 1.0);
    plan.until_end =
        plan.structure_seconds + told / std::max(spent_.jobs, 1) + search * spent_.after;
    const bool does_nothing =
        std::ranges::all_of(plan.moves, [](const auto& one) { return one.second->text.empty(); });
    if (!does_nothing && plan.until_end <= spent_.available) offer(plan);
    if (!(plan.seconds < cheapest_.seconds)) return;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
      if (bar_after(errors_[i], plan, doubt_) > bounds_[i]) return;
    }
    cheapest_ = std::move(plan);
  }

  /// One that there is time for.
  void offer(const Plan& plan) {
    double largest = 0.0;
    for (const Errors& one : errors_) largest = std::max(largest, bar_after(one, plan, doubt_));
    if (!(largest < least_left_)) return;
    least_left_ = largest;
    affordable_ = plan;
  }

  const std::vector<Errors>& errors_;
  SpentSeconds spent_;
  double tolerance_;
  double doubt_;
  std::vector<std::pair<std::string, const Moves*>> sources_;
  std::vector<double> bounds_;
  Plan cheapest_;
  Plan affordable_;
  double least_left_ = none;  ///< by that
};

/// Friction along r, several times as slow, is not for a peak that harmonics move far: on the
/// default blade 1.4 % of it with nine are 0.5 % with those that are needed.
bool may_be_else(const std::vector<Errors>& errors, double tolerance) {
  return largest_of(errors, "harmonics") > moves_away &&
         largest_of(errors, "second_direction") <= tolerance;
}

/// Every source that a bar has, and what can be done with it;
/// to leave it is the first of its moves.
std::map<std::string, Moves> all_moves(const SceneDescription& scene,
                                       const std::vector<Errors>& errors, double tolerance,
                                       const SpentSeconds& spent) {
  constexpr double idle = 1e-3;  // of the tolerance: too little to think about
  std::map<std::string, Moves> result;
  for (const Errors& one : errors) {
    for (const auto& [source, error] : one) result[source];
  }
  for (auto& [source, moves] : result) {
    const double error = largest_of(errors, source);
    moves.push_back({});
    if (error <= idle * tolerance) continue;
    if (source == "second_direction" && may_be_else(errors, tolerance)) continue;
    for (Move& move : moves_of(source, scene, tolerance, error, spent)) {
      moves.push_back(std::move(move));
    }
  }
  return result;
}

/// Where a bar is far above the tolerance what is small beside that waits: the curves that take
/// several times as long for it would do so in every round to come.
std::map<std::string, Moves> without_small_ones(std::map<std::string, Moves> moves,
                                                const std::vector<Errors>& errors,
                                                double tolerance) {
  constexpr double far = 4.0;  // times the tolerance
  constexpr double small = 0.25;
  const auto is_far = [&](const Errors& one) { return bar_of(one) > far * tolerance; };
  if (!std::ranges::any_of(errors, is_far)) return moves;
  for (auto& [source, own] : moves) {
    if (largest_of(errors, source) <= small * tolerance) own.resize(1);
  }
  return moves;
}

/// What keeps this program from having less of an error, where a user can do something about it.
std::string obstacle_to(const std::string& source, const SceneDescription& scene,
                        const SpentSeconds& spent) {
  const bool one_harmonic = setting_of(scene, "higher_harmonics") == "off";
  if (source == "harmonics" && one_harmonic) return " (effects.higher_harmonics = \"off\")";
  const bool no_room = source == "mesh" && is_mesh_refined_here(scene) && spent.cuts_in_memory == 0;
  return no_room ? " (elements cut in eight need more memory than there is)" : "";
}

/// Sources without a move whose error is no small part of the tolerance.
std::string stuck_sources(const std::map<std::string, Moves>& moves, const SceneDescription& scene,
                          const std::vector<Errors>& errors, double tolerance,
                          const SpentSeconds& spent) {
  constexpr double small = 0.05;
  std::vector<std::string> names;
  for (const auto& [source, own] : moves) {
    if (own.size() == 1 && largest_of(errors, source) > small * tolerance) {
      names.push_back(source + obstacle_to(source, scene, spent));
    }
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

double largest_bar(const std::vector<CurveBudget>& budgets, const std::vector<std::string>& goals) {
  double largest = 0.0;
  bool any = false;
  for (const CurveBudget& budget : budgets) {
    if (budget.rows.empty() && budget.unknown.empty()) continue;  // a linear limit
    if (!budget.has_bar()) return none;
    any = true;
    for (const std::string& goal : goals) {
      largest = std::max(largest, bar_of(budget.rows, budget.rows.front().curve, goal));
    }
  }
  return any ? largest : none;
}

bool is_exact(const CurveBudget& budget, const AccuracyRequest& accuracy) {
  const bool is_linear = budget.rows.empty() && budget.unknown.empty();
  return is_linear || largest_bar({budget}, accuracy.goals) <= accuracy.tolerance;
}

bool has_mesh_to_tell(const SceneDescription& scene, const std::vector<CurveBudget>& budgets) {
  if (!is_mesh_refined_here(scene)) return false;
  return std::get<MeshFileModel>(scene.model).refinement < most_cuts &&
         std::ranges::any_of(budgets, [](const auto& one) { return is_unknown(one, "mesh"); });
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
                                     const SpentSeconds& spent, std::string& left) {
  const double mesh = has_mesh_to_tell(scene, budgets)
                          ? (spent.linear_elements ? usual_of_linear : usual_of_mesh)
                          : 0.0;
  const std::vector<Errors> errors = errors_of(budgets, scene.accuracy.goals, mesh);
  const std::map<std::string, Moves> moves = all_moves(scene, errors, tolerance, spent);
  left = stuck_sources(moves, scene, errors, tolerance, spent);
  const std::map<std::string, Moves> of_round = without_small_ones(moves, errors, tolerance);
  const Plans plans(errors, of_round, spent, tolerance);
  const Plan& plan = plans.best();
  Refinement result{.scene = scene,
                    .text = {},
                    .seconds = plan.seconds,
                    .structure_seconds = plan.structure_seconds,
                    .curve_seconds = plan.curve_seconds,
                    .until_end = plan.until_end};
  result.only_harmonics = true;
  std::vector<std::string> texts;
  for (const auto& [source, move] : plan.moves) {
    if (move->text.empty()) continue;
    move->apply(result.scene);
    texts.push_back(move->text);
    if (move->structure > 0.0) result.new_mesh = true;
    if (source != "harmonics") result.only_harmonics = false;
  }
  if (texts.empty() || !gains(plan, errors, tolerance, doubt_of(spent))) return std::nullopt;
  result.text = fmt::format("{}", fmt::join(texts, ", "));
  return result;
}

}  // namespace microslip::pipelines
