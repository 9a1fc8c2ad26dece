#include "pipelines/files/write_report.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "pipelines/effects/beside_bar.hpp"
#include "pipelines/files/plot_script.hpp"
#include "pipelines/response/error_row.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/temporary_folder.hpp"
#include "pipelines/text/csv_table.hpp"
#include "pipelines/text/json_entry.hpp"
#include "pipelines/text/rounded.hpp"

namespace microslip::pipelines {
namespace {

/// Twenty curves with maps take about 15 s on one slow core.
constexpr std::chrono::seconds plot_limit{180};

/// Of a run with a budget what is left of it, at least a second.
std::chrono::milliseconds time_for_plots() {
  constexpr double least = 1.0;
  const double seconds = std::max(seconds_left(), least);
  const double limit = std::chrono::duration<double>(plot_limit).count();
  return std::chrono::milliseconds(static_cast<long>(1e3 * std::min(seconds, limit)));
}

/// plots/ and report.html. While a run goes on, its summary.json does not yet say how it ended.
std::string draw(const std::filesystem::path& folder, const std::filesystem::path& into,
                 const std::string& summary) {
  const TemporaryFolder scratch;
  const std::filesystem::path ended = scratch.path() / "summary.json";
  write_whole(ended, summary);
  const ResultCache* cache = ResultCache::in_use();
  const std::string kept = cache == nullptr ? "" : cache->folder().string();
  std::string failure = run_plot_script(
      "report_run.py", {folder.string(), into.string(), ended.string(), kept}, time_for_plots());
  if (!failure.empty() && seconds_left() < 1.0) {
    failure += fmt::format("; out of time: microslip report {} draws them", folder.string());
  }
  return failure;
}

}  // namespace

std::string read_summary(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw SceneError(fmt::format("{}: {}", folder.string(),
                                 std::filesystem::exists(folder, error)
                                     ? "not a folder; expected the folder of a run"
                                     : "no such folder"));
  }
  if (!std::filesystem::exists(file, error)) {
    throw SceneError(file.string() +
                     ": missing; is this the folder of a run, and has the run ended?");
  }
  constexpr std::uintmax_t largest = 1'000'000'000;  // bytes
  return read_text(file, largest);
}

namespace {

std::vector<std::string> plot_names(const std::filesystem::path& plots) {
  std::vector<std::string> names;
  std::error_code code;  // no folder: no plots
  for (const auto& entry : std::filesystem::directory_iterator(plots, code)) {
    if (entry.path().extension() == ".svg") names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string preload_text(const JsonEntry& curve) {
  if (!curve.has("preload_N")) return "–";  // beyond double precision
  const JsonEntry preload = curve.at("preload_N");
  return preload.is_text() ? preload.as_text() : fmt::format("{:g}", preload.as_number());
}

std::string structure_text(const JsonEntry& run) {
  std::string text;
  if (run.has("mesh")) {
    const JsonEntry mesh = run.at("mesh");
    text += fmt::format(
        "Mesh: {} nodes, {} elements, {} degrees of freedom, {:.6g} m³, {:.6g} kg.\n\n",
        mesh.integer("nodes"), mesh.integer("elements"), mesh.integer("degrees_of_freedom"),
        mesh.number("volume_m3"), mesh.number("mass_kg"));
  }
  text += "| mode | frequency [Hz] | damping ratio |\n|---:|---:|---:|\n";
  int number = 0;
  for (const JsonEntry& mode : run.list("modes")) {
    text += fmt::format("| {} | {:.4f} | {:.4g} |\n", ++number, mode.number("frequency_Hz"),
                        mode.number("damping_ratio"));
  }
  return text;
}

/// Where a largest amplitude is; a peak in runs that do not say.
std::string place_of(const JsonEntry& largest) {
  return largest.has("at") ? largest.text("at") : "peak";
}

std::string curve_row(const JsonEntry& curve) {
  std::string peak_text = "– | –";
  if (curve.has("peak")) {
    const JsonEntry peak = curve.at("peak");
    const auto number = [&](const char* key, const char* goal, const char* usual) {
      const double value = peak.number(key);
      std::string text = fmt::format(fmt::runtime(usual), value);
      if (!curve.has("bar") || !curve.at("bar").has(goal)) return text;
      std::string told = with_digits_of(value, curve.at("bar").number(goal));
      return told.size() < text.size() ? told : text;
    };
    peak_text = fmt::format("{}{} | {}", number("frequency_Hz", peak_frequency_goal, "{:.4f}"),
                            place_of(peak) == "range_end" ? " (end of the range)" : "",
                            number("amplitude_m", peak_amplitude_goal, "{:.5g}"));
  }
  std::string folds;
  for (const JsonEntry& fold : curve.list("folds_Hz")) {
    folds += fmt::format("{}{:.4f}", folds.empty() ? "" : ", ", fold.as_number());
  }
  const std::string name = curve.text("name");
  for (const JsonEntry& map : curve.list("maps"))
    static_cast<void>(map.as_text());  // the plots read them
  if (curve.has("preload_scale")) static_cast<void>(curve.number("preload_scale"));
  const std::string state = curve.truth("complete")
                                ? "complete"
                                : fmt::format("**incomplete**: {}", curve.text("diagnosis"));
  return fmt::format("| {} | {} | {} | {} | [{}](curves/{}.csv), {} points |\n",
                     preload_text(curve), peak_text, folds.empty() ? "–" : folds, state, name, name,
                     curve.integer("points"));
}

/// A sentence where the contact is open on a part of it; empty elsewhere and for limits.
std::string gap_text(const JsonEntry& curve) {
  if (!curve.has("preload_carried_N") || !curve.has("preload_integral_N")) return {};
  const double pressed = curve.number("preload_carried_N");
  const double gaps = pressed - curve.number("preload_integral_N");
  if (!(pressed > 0.0 && gaps > 1e-12 * pressed)) return {};  // sums round to 1e-14
  return fmt::format(
      "\nPreload {}: the contact carries {:.6g} N and is open on a part of it; the integral with "
      "the gaps counted "
      "as pull is {:.6g} N.\n",
      preload_text(curve), pressed, pressed - gaps);
}

/// A sentence where the search found other solutions.
std::string detached_text(const JsonEntry& curve) {
  const long n = curve.has("detached_branches") ? curve.integer("detached_branches") : 0;
  if (n <= 0) return {};
  const std::string name = curve.text("name");
  std::string files;
  for (long i = 1; i <= n; ++i) {
    files += fmt::format("{}[{}_detached_{}](curves/{}_detached_{}.csv)", i > 1 ? ", " : "", name,
                         i, name, i);
  }
  return fmt::format(
      "\nPreload {}: the search found {} beside this curve: {}.\n", preload_text(curve),
      n == 1 ? "another branch or solution" : fmt::format("{} other branches or solutions", n),
      files);
}

/// Effects that are left out, beside a bar; those of earlier versions do not say.
BesideBar left_out_of(const JsonEntry& bar) {
  BesideBar left_out;
  for (const JsonEntry& one : bar.list("left_out")) {
    double change = std::numeric_limits<double>::quiet_NaN();
    if (one.has("change")) {
      const JsonEntry told = one.at("change");
      change = told.is_number() ? told.as_number() : std::numeric_limits<double>::infinity();
    }
    left_out.emplace(one.text("effect"), change);
  }
  return left_out;
}

/// The best value of a search; the first versions searched the preload alone.
double value_of(const JsonEntry& optimum) {
  return optimum.number(optimum.has("value") ? "value" : "preload_N");
}

bool is_found(const JsonEntry& optimum) { return !optimum.has("found") || optimum.truth("found"); }

std::string text_or_none(const JsonEntry& entry, const char* key) {
  return entry.has(key) ? entry.text(key) : std::string();
}

/// Value, amplitude and frequency of a best peak as cells of a table, to the digits that the bar of
/// the best value allows. @param best  it, which has that bar or none.
std::string optimum_cells(const JsonEntry& peak, const JsonEntry& best) {
  if (!peak.has("amplitude_m")) return "– | – | – |\n";
  const bool barred = best.has("bar");
  const auto number = [&](double value, const char* goal, const char* usual) {
    return barred ? with_digits_of(value, best.at("bar").number(goal))
                  : fmt::format(fmt::runtime(usual), value);
  };
  const auto best_value = [&](double value) { return number(value, optimum_goal, "{:.6g}"); };
  const std::vector<JsonEntry> flat = peak.list("flat");
  const std::string value =
      flat.size() == 2
          ? fmt::format("{} … {}", best_value(flat[0].as_number()), best_value(flat[1].as_number()))
          : best_value(value_of(peak));
  return fmt::format("{} | {} | {}{} |\n", value,
                     number(peak.number("amplitude_m"), peak_amplitude_goal, "{:.5g}"),
                     number(peak.number("frequency_Hz"), peak_frequency_goal, "{:.4f}"),
                     place_of(peak) == "range_end" ? " (end of the range)" : "");
}

/// That a bracket's entry is searched with fewer harmonics than the best value.
std::string few_harmonics_text(const JsonEntry& entry) {
  return entry.has("harmonics") ? fmt::format(" with {:g} harmonics", entry.number("harmonics"))
                                : std::string();
}

/// Where the range of a bracket's entry is wider than that of the scene.
std::string range_text(const JsonEntry& entry) {
  if (!entry.has("range_widened") || !entry.truth("range_widened")) return {};
  const std::vector<JsonEntry> range = entry.list("range");
  return range.size() != 2 ? std::string()
                           : fmt::format(" (searched wider: {:.6g} … {:.6g})", range[0].as_number(),
                                         range[1].as_number());
}

std::string parameter_of(const JsonEntry& optimum) {
  return optimum.has("parameter") ? optimum.text("parameter") : "preload";
}

std::string optimum_sentence(const JsonEntry& optimum) {
  const std::string key = parameter_of(optimum);
  const std::string message = text_or_none(optimum, "message");
  if (!is_found(optimum)) return fmt::format("Best {} not found: {}.", key, message);
  const bool barred = optimum.has("bar");
  const auto number = [&](double value, const char* goal, const char* usual) {
    if (barred) return with_half_width(value, optimum.at("bar").number(goal));
    return fmt::format(fmt::runtime(usual), value);
  };
  const std::string energy =
      optimum.has("dissipated_energy_J") && barred && optimum.at("bar").has(dissipated_energy_goal)
          ? fmt::format(
                ", dissipating {} J in a period",
                number(optimum.number("dissipated_energy_J"), dissipated_energy_goal, "{:.5g}"))
          : "";
  const std::string beside = barred ? after_bar(left_out_of(optimum.at("bar"))) : "";
  return fmt::format("Best {}: {}{}, {} {} m at {} Hz{}{}{}{}.", key,
                     number(value_of(optimum), optimum_goal, "{:.6g}"),
                     key == "preload" ? " N" : " (SI)",
                     place_of(optimum) == "peak" ? "peak" : "largest amplitude",
                     number(optimum.number("amplitude_m"), peak_amplitude_goal, "{:.5g}"),
                     number(optimum.number("frequency_Hz"), peak_frequency_goal, "{:.4f}"), energy,
                     beside, message.empty() ? "" : "; ", message);
}

std::string optimum_text(const JsonEntry& optimum) {
  std::string text = fmt::format("\n{}\n\n", optimum_sentence(optimum));
  text += fmt::format(
      "| contact data | best {} | peak [m] | at [Hz] |\n|---|---:|---:|---:|\n| as given{} | ",
      parameter_of(optimum), is_found(optimum) ? "" : " (lowest, not found)");
  text += optimum_cells(optimum, optimum);
  for (const JsonEntry& entry : optimum.list("bracket")) {
    const std::string objection = is_found(entry) ? "" : text_or_none(entry, "objection");
    text += fmt::format("| {} × {:g}{}{}{} | ", entry.text("parameter"), entry.number("factor"),
                        few_harmonics_text(entry), range_text(entry),
                        is_found(entry)     ? ""
                        : objection.empty() ? " (lowest, not found)"
                                            : fmt::format(" (lowest: {})", objection)) +
            optimum_cells(entry, optimum);
  }
  for (const JsonEntry& reason : optimum.list("bracket_left_out")) {
    text += fmt::format("\nNot varied: {}.\n", reason.as_text());
  }
  return text;
}

std::string curves_text(const JsonEntry& run) {
  const std::vector<JsonEntry> curves = run.list("curves");
  std::string text =
      "| preload [N] | peak [Hz] | peak [m] | folds [Hz] | state | curve |\n"
      "|---:|---:|---:|---|---|---|\n";
  for (const JsonEntry& curve : curves) text += curve_row(curve);
  for (const JsonEntry& curve : curves) text += gap_text(curve) + detached_text(curve);
  if (run.has("optimum")) text += optimum_text(run.at("optimum"));
  return text;
}

/// Effects of one goal on one curve, the largest first: "harmonics +50 %, mesh +5.5 %".
std::string effects_text(const JsonEntry& run, const std::string& curve, const std::string& goal) {
  constexpr double least = 1e-5;  // of the goal: what no table needs
  std::vector<std::pair<double, std::string>> parts;
  for (const JsonEntry& row : run.list("error_budget")) {
    if (row.text("curve") != curve || row.text("goal") != goal) continue;
    if (std::abs(row.number("effect")) < least) continue;
    const bool borrowed = row.has("kind") && row.text("kind") == "borrowed";
    parts.emplace_back(row.number("effect"),
                       row.text("source") + (borrowed ? " (as of another curve)" : ""));
  }
  std::ranges::stable_sort(
      parts, [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  std::string text;
  for (const auto& [effect, source] : parts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", source, signed_percent_text(effect));
  }
  return text.empty() ? "–" : text;
}

/// What the bar of a curve leaves out, in words.
std::string not_in_bar_text(const JsonEntry& bar) {
  std::string text;
  for (const JsonEntry& source : bar.list("not_known")) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", source.as_text());
  }
  if (text.empty())
    text = beside_bar_text(left_out_of(bar));
  else
    text += after_bar(left_out_of(bar));
  return text.empty() ? "–" : text;
}

/// Dissipated energy of the highest peak, its half width and what makes it: three cells.
std::string energy_cells(const JsonEntry& run, const JsonEntry& curve) {
  const JsonEntry bar = curve.at("bar");
  if (!curve.at("peak").has("dissipated_energy_J")) return "– | – | –";  // of an earlier program
  if (!bar.has(dissipated_energy_goal)) return "nothing | – | –";
  const double width = bar.number(dissipated_energy_goal);
  return fmt::format(
      "{} | {} | {}", with_digits_of(curve.at("peak").number("dissipated_energy_J"), width),
      percent_text(width), effects_text(run, curve.text("name"), dissipated_energy_goal));
}

/// What was asked for, what was reached and by what; empty without a tolerance.
std::string accuracy_text(const JsonEntry& run) {
  if (!run.has("accuracy")) return {};
  const JsonEntry accuracy = run.at("accuracy");
  std::string text =
      fmt::format("Asked for {} of every peak, ", percent_text(accuracy.number("asked")));
  text += accuracy.has("reached") ? "reached " + percent_text(accuracy.number("reached"))
                                  : "reached what is not known of every curve";
  for (const JsonEntry& step : accuracy.list("refined")) text += "; then with " + step.as_text();
  return text + after_bar(left_out_of(accuracy)) + ".\n\n";
}

/// How far the peaks can be trusted; empty without a budget.
std::string budget_text(const JsonEntry& run) {
  if (!run.has("error_budget") || run.list("error_budget").empty()) return {};
  std::string text =
      "\n## How far the peaks can be trusted\n\n" + accuracy_text(run) +
      "What would be added to amplitude and dissipated energy of the highest peak if one choice "
      "were refined to its end; all of them together are the half width.\n\n"
      "| curve | peak [m] | amplitude ± | frequency ± | of the amplitude | dissipated [J] | ± | of "
      "the energy | not in ± |\n"
      "|---|---:|---:|---:|---|---:|---:|---|---|\n";
  for (const JsonEntry& curve : run.list("curves")) {
    if (!curve.has("bar") || !curve.has("peak")) continue;
    const JsonEntry bar = curve.at("bar");
    const int digits = static_cast<int>(curve.at("digits").integer("peak_amplitude"));
    text += fmt::format("| {} | {:.{}g} | {} | {} | {} | {} | {} |\n", curve.text("name"),
                        curve.at("peak").number("amplitude_m"), digits,
                        percent_text(bar.number("peak_amplitude")),
                        percent_text(bar.number("peak_frequency")),
                        effects_text(run, curve.text("name"), peak_amplitude_goal),
                        energy_cells(run, curve), not_in_bar_text(bar));
  }
  return text;
}

/// What having an effect that is left out would change.
std::string bound_text(const JsonEntry& effect) {
  if (!effect.has("bound")) return "–";
  if (!effect.at("bound").is_number()) return "peak not found";
  const std::string of_peaks = percent_text(effect.number("bound"));
  const bool more =
      effect.has("bound_along") && effect.number("bound_along") > effect.number("bound");
  return more ? fmt::format("{}, {} along a curve", of_peaks,
                            percent_text(effect.number("bound_along")))
              : of_peaks;
}

/// Of an indicator, or its limit.
std::string number_text(const JsonEntry& effect, const char* key) {
  if (!effect.has(key)) return "–";
  const JsonEntry value = effect.at(key);
  return value.is_number() ? fmt::format("{:.2g}", value.as_number()) : value.as_text();
}

/// Which effects were simulated, and why; empty: not told.
std::string simulated_text(const JsonEntry& run) {
  if (run.list("effects").empty()) return {};
  std::string text =
      "\n## Effects\n\nBound: what having the effect changes the highest peaks by, at most; along "
      "a curve an amplitude at its frequency, over the highest, the largest of a sample.\n\n"
      "| effect | simulated | setting | indicator | limit | bound | why |\n"
      "|---|---|---|---:|---:|---:|---|\n";
  for (const JsonEntry& effect : run.list("effects")) {
    const char* simulated = !effect.has("simulated")    ? "not decided"
                            : effect.truth("simulated") ? "yes"
                                                        : "no";
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {}", effect.text("name"), simulated,
                    effect.text("setting"), number_text(effect, "indicator"),
                    number_text(effect, "threshold"), bound_text(effect), effect.text("reason"));
    if (effect.has("objection") && !effect.text("objection").empty()) {
      text += "; **but " + effect.text("objection") + "**";
    }
    text += " |\n";
  }
  return text;
}

std::string cost_text(const JsonEntry& run) {
  std::string text = "| stage | seconds | memory [MB] |\n|---|---:|---:|\n";
  for (const JsonEntry& stage : run.list("stages")) {
    if (stage.text("name") == "report") continue;  // this text is part of it
    text += fmt::format("| {} | {:.2f} | {:.0f} |\n", stage.text("name"), stage.number("seconds"),
                        stage.number("peak_memory_MB"));
  }
  if (!run.has("machine")) return text;
  const JsonEntry machine = run.at("machine");
  return text + fmt::format("\n{}, {} cores; {}.\n", machine.text("processor"),
                            machine.integer("cores"), machine.text("blas"));
}

std::string plots_text(const std::vector<std::string>& plots) {
  std::string text;
  for (const std::string& plot : plots) {
    const std::string stem = std::filesystem::path(plot).stem().string();
    text += fmt::format("![{}](plots/{})\n\n", stem, plot);
  }
  return text.empty() ? "None.\n" : text;
}

}  // namespace

std::string report_text(const std::string& summary_json, const std::vector<std::string>& plots,
                        const std::string& name) {
  const nlohmann::ordered_json document = parse_json(summary_json, name);
  const JsonEntry run(document, name);
  static_cast<void>(run.at("curves"));  // there even without any: else it is another file
  const std::string title = text_or_none(run, "title");
  std::string text = fmt::format("# {}\n\n", title.empty() ? "microslip run" : title);
  if (const long code = run.has("exit_code") ? run.integer("exit_code") : 0; code != 0) {
    text += fmt::format("**Exit code {}.** {}\n\n", code, text_or_none(run, "message"));
  }
  for (const JsonEntry& warning : run.list("warnings")) {
    text += fmt::format("- warning: {}\n", warning.as_text());
  }
  text += "\n## Structure\n\n" + structure_text(run);
  if (!run.list("curves").empty()) text += "\n## Response\n\n" + curves_text(run);
  return text.append(budget_text(run))
      .append(simulated_text(run))
      .append("\n## Plots\n\n")
      .append(plots_text(plots))
      .append("\n## Cost\n\n")
      .append(cost_text(run));
}

std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const std::filesystem::path& into,
                                      const std::string& summary) {
  const std::string name = (folder / "summary.json").string();
  static_cast<void>(
      report_text(summary, {}, name));  // a damaged summary is told before plots are made of it
  const std::filesystem::path plots = into / "plots";
  std::vector<std::string> warnings;
  if (const std::string failure = draw(folder, into, summary); !failure.empty()) {
    warnings.push_back(failure);
  }
  write_whole(into / "report.md", report_text(summary, plot_names(plots), name));
  return warnings;
}

}  // namespace microslip::pipelines
