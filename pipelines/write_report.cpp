#include "pipelines/write_report.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "pipelines/output_file.hpp"
#include "pipelines/plot_script.hpp"
#include "pipelines/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Json = nlohmann::ordered_json;

/// Twenty curves with maps take about 15 s on one slow core.
constexpr std::chrono::seconds plot_limit{180};

std::string make_plots(const std::filesystem::path& folder) {
  return run_plot_script("plot_run.py", {folder.string()}, plot_limit);
}

std::string read_summary(const std::filesystem::path& folder) {
  std::ifstream in(folder / "summary.json");
  if (!in) {
    throw SceneError((folder / "summary.json").string() +
                     ": cannot be read; is this the folder of a run?");
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> plot_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code code;  // no folder: no plots
  for (const auto& entry : std::filesystem::directory_iterator(folder / "plots", code)) {
    if (entry.path().extension() == ".svg") names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string preload_text(const Json& curve) {
  const Json& preload = curve.at("preload_N");
  return preload.is_string() ? preload.get<std::string>()
                             : fmt::format("{:g}", preload.get<double>());
}

std::string structure_text(const Json& run) {
  std::string text;
  if (const Json& mesh = run.at("mesh"); !mesh.is_null()) {
    text +=
        fmt::format("Mesh: {} nodes, {} elements, {} degrees of freedom, {:.6g} m³, {:.6g} kg.\n\n",
                    mesh.at("nodes").get<long>(), mesh.at("elements").get<long>(),
                    mesh.at("degrees_of_freedom").get<long>(), mesh.at("volume_m3").get<double>(),
                    mesh.at("mass_kg").get<double>());
  }
  text += "| mode | frequency [Hz] | damping ratio |\n|---:|---:|---:|\n";
  int number = 0;
  for (const Json& mode : run.at("modes")) {
    text +=
        fmt::format("| {} | {:.4f} | {:.4g} |\n", ++number, mode.at("frequency_Hz").get<double>(),
                    mode.at("damping_ratio").get<double>());
  }
  return text;
}

std::string curve_row(const Json& curve) {
  const Json& peak = curve.at("peak");
  const std::string peak_text =
      peak.is_null() ? "– | –"
                     : fmt::format("{:.4f} | {:.5g}", peak.at("frequency_Hz").get<double>(),
                                   peak.at("amplitude_m").get<double>());
  std::string folds;
  for (const Json& fold : curve.at("folds_Hz")) {
    folds += fmt::format("{}{:.4f}", folds.empty() ? "" : ", ", fold.get<double>());
  }
  const std::string name = curve.at("name").get<std::string>();
  const std::string state =
      curve.at("complete").get<bool>()
          ? "complete"
          : fmt::format("**incomplete**: {}", curve.at("diagnosis").get<std::string>());
  return fmt::format("| {} | {} | {} | {} | [{}](curves/{}.csv), {} points |\n",
                     preload_text(curve), peak_text, folds.empty() ? "–" : folds, state, name, name,
                     curve.at("points").get<long>());
}

/// A sentence where the contact is open on a part of it; empty elsewhere and for limits.
std::string gap_text(const Json& curve) {
  const Json carried = curve.value("preload_carried_N", Json());
  const Json integral = curve.value("preload_integral_N", Json());
  if (!carried.is_number() || !integral.is_number()) return {};
  const double pressed = carried.get<double>();
  const double gaps = pressed - integral.get<double>();
  if (!(pressed > 0.0 && gaps > 1e-12 * pressed)) return {};  // sums round to 1e-14
  return fmt::format(
      "\nPreload {}: the contact carries {:.6g} N and is open on a part of it; the integral with the gaps counted "
      "as pull is {:.6g} N.\n",
      preload_text(curve), pressed, pressed - gaps);
}

/// A sentence where the search found other solutions.
std::string detached_text(const Json& curve) {
  const long n = curve.value("detached_branches", 0L);
  if (n == 0) return {};
  const std::string name = curve.at("name").get<std::string>();
  std::string files;
  for (long i = 1; i <= n; ++i) {
    files += fmt::format("{}[{}_detached_{}](curves/{}_detached_{}.csv)", i > 1 ? ", " : "", name, i, name, i);
  }
  return fmt::format("\nPreload {}: the search found {} beside this curve: {}.\n", preload_text(curve),
                     n == 1 ? "another branch or solution" : fmt::format("{} other branches or solutions", n),
                     files);
}

/// Value, amplitude and frequency of a best peak as cells of a table.
std::string optimum_cells(const Json& peak) {
  if (peak.at("amplitude_m").is_null()) return "– | – | – |\n";
  const Json& flat = peak.at("flat");
  const std::string value =
      flat.is_null() ? fmt::format("{:.6g}", peak.at("value").get<double>())
                     : fmt::format("{:.6g} … {:.6g}", flat.at(0).get<double>(), flat.at(1).get<double>());
  const bool at_end = peak.at("at") == "range_end";
  return fmt::format("{} | {:.5g} | {:.4f}{} |\n", value, peak.at("amplitude_m").get<double>(),
                     peak.at("frequency_Hz").get<double>(), at_end ? " (end of the range)" : "");
}

std::string optimum_sentence(const Json& optimum) {
  const std::string key = optimum.at("parameter").get<std::string>();
  const std::string message = optimum.at("message").get<std::string>();
  if (!optimum.at("found").get<bool>()) return fmt::format("Best {} not found: {}.", key, message);
  return fmt::format("Best {}: {:.6g}{}, {} {:.5g} m at {:.4f} Hz; {}.", key,
                     optimum.at("value").get<double>(), key == "preload" ? " N" : " (SI)",
                     optimum.at("at") == "peak" ? "peak" : "largest amplitude",
                     optimum.at("amplitude_m").get<double>(),
                     optimum.at("frequency_Hz").get<double>(), message);
}

std::string optimum_text(const Json& optimum) {
  const std::string key = optimum.at("parameter").get<std::string>();
  std::string text = fmt::format("\n{}\n\n", optimum_sentence(optimum));
  text += fmt::format("| contact data | best {} | peak [m] | at [Hz] |\n|---|---:|---:|---:|\n| as given{} | ",
                      key, optimum.at("found").get<bool>() ? "" : " (lowest, not found)");
  text += optimum_cells(optimum);
  for (const Json& entry : optimum.at("bracket")) {
    const bool found = entry.at("found").get<bool>();
    text += fmt::format("| {} × {:g}{} | ", entry.at("parameter").get<std::string>(),
                        entry.at("factor").get<double>(),
                        found ? "" : fmt::format(" (lowest: {})", entry.at("objection").get<std::string>())) +
            optimum_cells(entry);
  }
  for (const Json& reason : optimum.at("bracket_left_out")) {
    text += fmt::format("\nNot varied: {}.\n", reason.get<std::string>());
  }
  return text;
}

std::string curves_text(const Json& run) {
  std::string text =
      "| preload [N] | peak [Hz] | peak [m] | folds [Hz] | state | curve |\n"
      "|---:|---:|---:|---|---|---|\n";
  for (const Json& curve : run.at("curves")) text += curve_row(curve);
  for (const Json& curve : run.at("curves")) text += gap_text(curve) + detached_text(curve);
  if (const Json& optimum = run.at("optimum"); !optimum.is_null()) text += optimum_text(optimum);
  return text;
}

std::string cost_text(const Json& run) {
  std::string text = "| stage | seconds | memory [MB] |\n|---|---:|---:|\n";
  for (const Json& stage : run.at("stages")) {
    if (stage.at("name") == "report") continue;  // this text is part of it
    text +=
        fmt::format("| {} | {:.2f} | {:.0f} |\n", stage.at("name").get<std::string>(),
                    stage.at("seconds").get<double>(), stage.at("peak_memory_MB").get<double>());
  }
  const Json& machine = run.at("machine");
  return text + fmt::format("\n{}, {} cores; {}.\n", machine.at("processor").get<std::string>(),
                            machine.at("cores").get<int>(), machine.at("blas").get<std::string>());
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

std::string report_text(const std::string& summary_json, const std::vector<std::string>& plots) {
  try {
    const Json run = Json::parse(summary_json);
    const std::string title = run.value("title", std::string());
    std::string text = fmt::format("# {}\n\n", title.empty() ? "microslip run" : title);
    if (const int code = run.at("exit_code").get<int>(); code != 0) {
      text += fmt::format("**Exit code {}.** {}\n\n", code, run.value("message", std::string()));
    }
    for (const Json& warning : run.at("warnings")) {
      text += fmt::format("- warning: {}\n", warning.get<std::string>());
    }
    text += "\n## Structure\n\n" + structure_text(run);
    if (!run.at("curves").empty()) text += "\n## Response\n\n" + curves_text(run);
    return text.append("\n## Plots\n\n")
        .append(plots_text(plots))
        .append("\n## Cost\n\n")
        .append(cost_text(run));
  } catch (const Json::exception& error) {
    throw SceneError(std::string("summary.json: ") + error.what());
  }
}

std::vector<std::string> write_report(const std::filesystem::path& folder) {
  const std::string summary = read_summary(folder);
  std::vector<std::string> warnings;
  if (const std::string failure = make_plots(folder); !failure.empty()) warnings.push_back(failure);
  write_whole(folder / "report.md", report_text(summary, plot_names(folder)));
  return warnings;
}

void rebuild_report(const std::filesystem::path& folder) {
  const std::vector<std::string> warnings = write_report(folder);
  if (!warnings.empty()) throw SceneError(folder.string() + ": " + warnings.front());
}

}  // namespace microslip::pipelines
