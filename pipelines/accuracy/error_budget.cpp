#include "pipelines/accuracy/error_budget.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "pipelines/response/response_stage.hpp"
#include "pipelines/system/deadline.hpp"
#include "solver/richer_peak.hpp"

namespace microslip::pipelines {
namespace {

constexpr const char* amplitude = peak_amplitude_goal;
constexpr const char* frequency = peak_frequency_goal;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Both goals of one source.
void add_rows(CurveBudget& budget, const std::string& curve, const std::string& source,
              const std::pair<double, double>& effects, ErrorKind kind, double seconds) {
  budget.rows.push_back({curve, amplitude, source, effects.first, kind, seconds});
  budget.rows.push_back({curve, frequency, source, effects.second, kind, seconds});
}

/// Relative change of amplitude and frequency.
std::pair<double, double> changes(const solver::PeakOfBoth& peak) {
  return {peak.other_amplitude / peak.amplitude - 1.0, peak.other_frequency / peak.frequency - 1.0};
}

/// Of the natural frequency nearest to the peak. Models with other modes keep the first of them.
double frequency_factor(const ReducedModel& model, const ReducedModel& other, double peak) {
  Eigen::Index nearest = 0;
  (model.frequency.array() - peak).abs().minCoeff(&nearest);
  const bool usual = nearest < other.frequency.size() && model.frequency[nearest] > 0.0;
  return usual ? other.frequency[nearest] / model.frequency[nearest] : 1.0;
}

void add_model(CurveBudget& budget, const ReducedModel& model, const SceneDescription& scene,
               const RicherModel& richer, const CurveResult& result, double load) {
  const auto begin = std::chrono::steady_clock::now();
  solver::ContinuationOptions options = continuation_options(scene, model);
  options.search_starts = 0;
  const solver::Scene own = solver_scene(model, load);
  const solver::Scene other = solver_scene(richer.model, load);
  const double factor =
      frequency_factor(model, richer.model, highest_peak(result.curve)->frequency);
  const auto peak =
      solver::peak_elsewhere(own, options, result.curve, {other, richer.embedding, factor});
  if (!peak || !(peak->amplitude > 0.0)) {
    budget.unknown.push_back(richer.source);
    return;
  }
  auto [by_amplitude, by_frequency] = changes(*peak);
  add_rows(budget, result.name, richer.source,
           {richer.share * by_amplitude, richer.share * by_frequency}, ErrorKind::solved,
           seconds_since(begin));
}

/// The choice of harmonics was cut short, or did not end.
bool is_unsettled(const solver::ResponseCurve& curve) {
  return std::ranges::any_of(curve.log, [](const solver::SolverEvent& event) {
    return event.remedy == solver::Remedy::harmonics_kept;
  });
}

/// Given harmonics have been solved with more; of chosen ones the peak knows what is left out.
/// @param is_told  the curve was solved with chosen harmonics, or more of them are known to do nothing.
void add_harmonics(CurveBudget& budget, const CurveResult& result,
                   const solver::ResponsePoint& peak, bool is_told) {
  const solver::SettledPeak& settled = result.curve.settled_peak;
  if (!result.richer && settled.amplitude > 0.0) {
    const double change = settled.amplitude / peak.amplitude - 1.0;
    add_rows(budget, result.name, "harmonics",
             {change + std::copysign(settled.left_out, change),
              settled.frequency / peak.frequency - 1.0},
             ErrorKind::solved, 0.0);
  } else if (!result.richer && !is_told) {
    budget.unknown.emplace_back("harmonics");
  } else if (!result.richer && is_unsettled(result.curve) && peak.harmonics_left_out == 0.0) {
    budget.unknown.emplace_back("harmonics");
  } else if (!result.richer) {
    add_rows(budget, result.name, "harmonics", {peak.harmonics_left_out, 0.0}, ErrorKind::estimated,
             0.0);
  } else if (result.richer->change) {
    add_rows(budget, result.name, "harmonics",
             {result.richer->amplitude / peak.amplitude - 1.0,
              result.richer->frequency / peak.frequency - 1.0},
             ErrorKind::solved, result.richer->seconds);
  } else {
    budget.unknown.emplace_back("harmonics");
  }
}

/// How far Newton's method went: the balance of energy of the peak.
void add_certificate(CurveBudget& budget, const CurveResult& result,
                     const solver::ResponsePoint& peak) {
  add_rows(budget, result.name, "newton", {peak.energy_imbalance, 0.0}, ErrorKind::estimated, 0.0);
}

/// Of one source and goal, over all curves that know it.
const ErrorRow* largest_row(const std::vector<CurveBudget>& budgets, const std::string& source,
                            const char* goal) {
  const ErrorRow* largest = nullptr;
  for (const CurveBudget& budget : budgets) {
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

void borrow_unknown(std::vector<CurveBudget>& budgets) {
  for (CurveBudget& budget : budgets) {
    if (budget.rows.empty() || !budget.has_bar()) continue;
    const std::string curve = budget.rows.front().curve;
    std::erase_if(budget.unknown, [&](const std::string& source) {
      const ErrorRow* of_amplitude = largest_row(budgets, source, amplitude);
      const ErrorRow* of_frequency = largest_row(budgets, source, frequency);
      if (of_amplitude == nullptr || of_frequency == nullptr) return false;
      add_rows(budget, curve, source, std::pair(of_amplitude->effect, of_frequency->effect),
               ErrorKind::borrowed, 0.0);
      return true;
    });
  }
}

bool CurveBudget::has_bar() const {
  return !rows.empty() && std::ranges::find(unknown, "harmonics") == unknown.end();
}

CurveBudget error_budget(const ReducedModel& model, const SceneDescription& scene,
                         const RicherModels& richer, const CurveResult& result) {
  CurveBudget budget;
  const auto* load = std::get_if<double>(&result.load);
  const solver::ResponsePoint* peak = highest_peak(result.curve);
  if (load == nullptr || peak == nullptr || result.integrated || !(peak->amplitude > 0.0)) {
    return budget;
  }
  if (!result.curve.complete) {  // its highest peak need not be there
    budget.unknown = richer.unknown;
    budget.unknown.emplace_back("harmonics");
    return budget;
  }
  budget.unknown = richer.unknown;
  const bool is_told = scene.settings.harmonics.chosen() || !result.curve.certificate.empty();
  add_harmonics(budget, result, *peak, is_told);
  for (const RicherModel& other : richer.models) {
    if (cut_short()) {
      budget.unknown.push_back(other.source);
      continue;
    }
    add_model(budget, model, scene, other, result, *load);
  }
  add_certificate(budget, result, *peak);
  return budget;
}

std::string budget_text(const CurveBudget& budget) {
  if (budget.rows.empty()) return {};
  constexpr double percent = 100.0;
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
  std::string text = fmt::format("curve {}: peak ± {:.2g} %, its frequency ± {:.2g} %:", curve,
                                 percent * bar_of(budget.rows, curve, amplitude),
                                 percent * bar_of(budget.rows, curve, frequency));
  constexpr std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, parts.size()); ++i) {
    text += fmt::format("{} {} {:+.2g} %", i > 0 ? "," : "", parts[i].source,
                        percent * parts[i].effect);
    if (parts[i].kind == ErrorKind::borrowed) text += " (as of another curve)";
  }
  if (!budget.unknown.empty()) {
    text += fmt::format("; not known: {}", fmt::join(budget.unknown, ", "));
  }
  return text;
}

}  // namespace microslip::pipelines
