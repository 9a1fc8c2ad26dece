#include "pipelines/stages/missed_effects.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/description/effects_left_out.hpp"
#include "pipelines/response/highest_peak.hpp"
#include "pipelines/stages/solved_again.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

std::vector<MissedEffect> missed_in(const Solution& solution) {
  std::vector<ErrorRow> rows;
  for (const CurveBudget& budget : solution.budgets) {
    rows.insert(rows.end(), budget.rows.begin(), budget.rows.end());
    rows.insert(rows.end(), budget.left_out.begin(), budget.left_out.end());
  }
  std::vector<MissedEffect> missed =
      missed_effects(rows, tolerance_of_effects(solution.scene), effects_of(solution));
  std::erase_if(missed, [&](const MissedEffect& one) {  // at most once each
    return std::ranges::find(solution.switched_on, one.name, &MissedEffect::name) !=
           solution.switched_on.end();
  });
  return missed;
}

/// As if the user had switched them on; the table of effects tells who did.
SceneDescription with_effects(SceneDescription scene, const std::vector<MissedEffect>& missed) {
  for (const MissedEffect& one : missed) {
    if (left_out(scene, one.name) != nullptr) scene = with_effect(scene, one.name);
    for (auto& [effect, setting] : scene.effects) {
      if (effect == one.name) setting = "on";
    }
    if (one.name == "second_direction") {
      scene.settings.second_direction = Discretisation::Choice::on;
    }
  }
  return scene;
}

std::string names_of(const std::vector<MissedEffect>& missed) {
  std::vector<std::string> names;
  names.reserve(missed.size());
  for (const MissedEffect& one : missed) {
    names.push_back(std::isinf(one.change) ? one.name + " (the highest peak is lost with it)"
                                           : fmt::format("{} ({} of a highest peak)", one.name,
                                                         percent_text(one.change)));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// What the highest peaks without the effects are off by, amplitude or frequency.
double largest_change(const Solution& without, const Solution& with) {
  double largest = 0.0;
  for (std::size_t i = 0; i < with.curves.size(); ++i) {
    const solver::ResponsePoint* before = highest_peak(without.curves[i].curve);
    const solver::ResponsePoint* now = highest_peak(with.curves[i].curve);
    if (before == nullptr || now == nullptr) continue;
    largest = std::max({largest, std::abs(before->amplitude / now->amplitude - 1.0),
                        std::abs(before->frequency / now->frequency - 1.0)});
  }
  return largest;
}

/// A peak that was not found from that without is there now:
/// what leaving the effects out changes is known.
void tell_change(const Solution& without, Solution& with) {
  for (MissedEffect& one : with.switched_on) {
    if (std::isinf(one.change)) one.change = largest_change(without, with);
  }
}

}  // namespace

bool put_back_missed_effects(Solution& solution, int jobs, RunRecord& record) {
  for (std::vector<MissedEffect> missed = missed_in(solution); !missed.empty();
       missed = missed_in(solution)) {
    const std::string names = names_of(missed);
    if (cut_short()) {
      record.progress().warning("out of time: left out though it matters: " + names);
      return false;
    }
    record.progress().info("left out, and it matters: " + names +
                           "; all curves are solved again with it");
    Solution before = solution;
    before.switched_on.insert(before.switched_on.end(), missed.begin(), missed.end());
    const Refinement step{with_effects(solution.scene, missed), names};
    std::string obstacle;
    auto round = solved_again(before, step, jobs, record.progress(), obstacle);
    if (!round) {
      record.progress().warning(fmt::format("left out though it matters: {}: {}", names,
                                            obstacle.empty() ? "out of time" : obstacle));
      return false;
    }
    tell_change(solution, round->solution);
    keep_solved_again(*round, false, record);
    solution = std::move(round->solution);
  }
  return true;
}

}  // namespace microslip::pipelines
