#include "pipelines/files/write_summary.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "pipelines/files/columns.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/text/effect_table.hpp"
#include "pipelines/text/units.hpp"

namespace microslip::pipelines {
namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// JSON knows no infinity: it is told as a text.
Json finite_or_null(const std::optional<double>& value) {
  if (value && std::isinf(*value)) return "infinite";
  return or_null(value);
}

Json to_json(const std::variant<double, LimitName>& preload) {
  if (const double* newton = std::get_if<double>(&preload)) return *newton;
  return std::get<LimitName>(preload) == LimitName::free ? "free" : "stuck";
}

Json to_json(const PeakSummary& peak) {
  return {{"frequency_Hz", in_hertz(peak.frequency)},
          {"amplitude_m", peak.amplitude},
          {"dissipated_energy_J", peak.dissipated_energy},
          {"at", peak.at_range_end ? "range_end" : "peak"}};
}

Json to_json(const Machine& machine) {
  return {{"processor", machine.processor},
          {"cores", machine.cores},
          {"memory_MB", machine.memory_mb},
          {"blas", machine.blas},
          {"blas_threads", machine.blas_threads}};
}

Json to_json(const StageRecord& stage) {
  return {
      {"name", stage.name}, {"seconds", stage.seconds}, {"peak_memory_MB", stage.peak_memory_mb}};
}

Json to_json(const MeshSummary& mesh) {
  return {{"nodes", mesh.nodes},
          {"elements", mesh.elements},
          {"degrees_of_freedom", mesh.degrees_of_freedom},
          {"volume_m3", mesh.volume},
          {"mass_kg", mesh.mass}};
}

Json to_json(const ModeSummary& mode) {
  Json json{{"frequency_Hz", in_hertz(mode.frequency)},
            {"damping_ratio", mode.damping_ratio},
            {"residual", or_null(mode.residual)},
            {"kind", mode.is_attachment ? "attachment" : "free"}};
  if (mode.fit_error) json["fit_error"] = *mode.fit_error;
  return json;
}

Json to_json(const CurveSummary& curve);
Json to_json(const ErrorRow& row);
Json to_json(const EffectRecord& effect);
Json to_json(const solver::SolverEvent& event) {
  return {{"frequency_Hz", in_hertz(event.frequency)}, {"remedy", solver::to_string(event.remedy)}};
}
Json to_json(const solver::PeakOfParameter& peak, const OptimumSummary& summary) {
  std::optional<double> load = summary.request.load;  // none: that of the static loads, which vary
  if (summary.request.of_preload()) load = peak.parameter;
  return {{"preload_N", load ? Json(*load * summary.newtons_per_load) : Json(nullptr)},
          {"value", peak.parameter},
          {"amplitude_m", peak.amplitude},
          {"frequency_Hz", in_hertz(peak.frequency)},
          {"at", to_string(peak.place)},
          {"detached", peak.detached}};
}

/// The lowest value of a search and why it is not the best; nulls where nothing was solved.
Json to_json(const solver::Optimum& optimum, const OptimumSummary& summary) {
  Json json = to_json(optimum.best, summary);
  if (optimum.trace.empty()) {
    for (const char* key : {"preload_N", "value", "amplitude_m", "frequency_Hz", "at"}) {
      json[key] = nullptr;
    }
  }
  json["found"] = optimum.found;
  json["objection"] = optimum.objection;
  json["flat"] = optimum.flat ? Json(*optimum.flat) : Json(nullptr);
  return json;
}

template <typename Item>
Json to_array(const std::vector<Item>& items) {
  Json array = Json::array();
  for (const Item& item : items) array.push_back(to_json(item));
  return array;
}

/// Change null: not known.
Json to_json(const BesideBar& left_out) {
  Json effects = Json::array();
  for (const auto& [effect, change] : left_out) {
    const Json told = std::isnan(change) ? Json(nullptr) : finite_or_null(change);
    effects.push_back({{"effect", effect}, {"change", told}});
  }
  return effects;
}

/// Null: not found from the peak of the curve.
Json to_json(const solver::RicherPeak& peak) {
  const bool found = peak.change.has_value();
  return {{"highest", peak.highest},
          {"beyond", peak.beyond},
          {"frequency_Hz", found ? Json(in_hertz(peak.frequency)) : Json(nullptr)},
          {"amplitude_m", found ? Json(peak.amplitude) : Json(nullptr)}};
}

/// Half widths by goal, null of an energy that friction does not dissipate; null without a budget,
/// and where the harmonics given do not tell the curve.
Json bar_json(const CurveSummary& curve, const std::vector<ErrorRow>& budget) {
  Json bar = Json::object();
  if (std::ranges::find(curve.not_in_bar, "harmonics") != curve.not_in_bar.end()) return nullptr;
  for (const ErrorRow& row : budget) {
    if (row.curve == curve.name) bar[row.goal] = bar_of(budget, curve.name, row.goal);
  }
  if (bar.empty()) return nullptr;
  if (!bar.contains(dissipated_energy_goal)) bar[dissipated_energy_goal] = nullptr;
  bar["not_known"] = curve.not_in_bar;
  bar["left_out"] = to_json(curve.left_out);
  return bar;
}

/// Significant digits that a relative half width allows. What it does not count may be larger.
int digits_of(double bar, bool counts_all) {
  const double most = counts_all ? 8.0 : 3.0;
  return static_cast<int>(bar > 0.0 ? std::clamp(std::floor(1.0 - std::log10(bar)), 1.0, most)
                                    : most);
}

/// Of every half width.
Json digits_json(const Json& bar) {
  if (bar.is_null()) return nullptr;
  Json digits = Json::object();
  const bool counts_all = bar.at("not_known").empty();
  for (const auto& [goal, width] : bar.items()) {
    if (width.is_number()) digits[goal] = digits_of(width.get<double>(), counts_all);
    if (width.is_null()) digits[goal] = nullptr;
  }
  return digits;
}

const char* kind_text(ErrorKind kind) {
  if (kind == ErrorKind::borrowed) return "borrowed";
  return kind == ErrorKind::solved ? "solved" : "estimated";
}

Json to_json(const ErrorRow& row) {
  const double gain = row.seconds > 0.0 ? std::abs(row.effect) / row.seconds : 0.0;
  return {{"curve", row.curve},          {"goal", row.goal},
          {"source", row.source},        {"effect", row.effect},
          {"kind", kind_text(row.kind)}, {"seconds", row.seconds},
          {"gain_per_second", gain}};
}

Json to_json(const AccuracySummary& accuracy) {
  const bool known = std::isfinite(accuracy.reached);
  return {{"asked", accuracy.asked > 0.0 ? Json(accuracy.asked) : Json("off")},
          {"reached", known ? Json(accuracy.reached) : Json(nullptr)},
          {"not_known", accuracy.not_known},
          {"left_out", to_json(accuracy.left_out)},
          {"refined", accuracy.refined},
          {"out_of_time", accuracy.out_of_time},
          {"message", accuracy.message}};
}

/// Curves, each with its bar and the digits it allows.
Json curves_json(const RunSummary& summary) {
  Json curves = to_array(summary.curves);
  for (std::size_t i = 0; i < summary.curves.size(); ++i) {
    Json bar = bar_json(summary.curves[i], summary.error_budget);
    curves[i]["digits"] = digits_json(bar);
    curves[i]["bar"] = std::move(bar);
  }
  return curves;
}

Json to_json(const CurveSummary& curve) {
  Json folds = Json::array();
  for (const double fold : curve.folds) folds.push_back(in_hertz(fold));
  return {{"name", curve.name},
          {"preload_N", to_json(curve.preload)},
          {"gap_m", or_null(curve.gap)},
          {"preload_scale", curve.preload_scale ? Json(*curve.preload_scale) : Json(nullptr)},
          {"preload_carried_N", or_null(curve.preload_carried)},
          {"preload_integral_N", or_null(curve.preload_integral)},
          {"complete", curve.complete},
          {"diagnosis", solver::to_string(curve.diagnosis)},
          {"message", curve.message},
          {"peak", curve.peak ? to_json(*curve.peak) : Json(nullptr)},
          {"peaks", to_array(curve.peaks)},
          {"folds_Hz", folds},
          {"points", curve.points},
          {"iterations", curve.iterations},
          {"contact_evaluations", curve.contact_evaluations},
          {"state_readings", curve.state_readings},
          {"state_cuts", curve.state_cuts},
          {"seconds", curve.seconds},
          {"largest_residual", curve.largest_residual},
          {"largest_energy_imbalance", curve.largest_energy_imbalance},
          {"largest_dissipation_mismatch", curve.largest_dissipation_mismatch},
          {"stable_unproved", curve.stable_unproved},
          {"largest_three_states_share", curve.largest_three_states_share},
          {"harmonics",
           {{"most", curve.most_harmonics},
            {"orders", curve.harmonic_orders},
            {"largest_left_out", curve.largest_left_out},
            {"with_more", curve.richer ? to_json(*curve.richer) : Json(nullptr)}}},
          {"maps", curve.maps},
          {"certificate", curve.certificate},
          {"remedies", to_array(curve.remedies)},
          {"detached_branches", curve.detached_branches},
          {"search_starts", curve.search_starts}};
}

Json to_json(const IndicatorAlong& along) {
  return {{"indicator", finite_or_null(along.indicator)},
          {"curve", along.curve},
          {"frequency_Hz", along.frequency_hz}};
}
Json to_json(const EffectRecord& effect) {
  return {{"name", effect.name},
          {"setting", effect.setting},
          {"simulated", effect.simulated == Simulated::undecided
                            ? Json(nullptr)
                            : Json(effect.simulated == Simulated::yes)},
          {"reason", effect.reason},
          {"quantity", effect_row(effect.name).quantity},
          {"indicator", finite_or_null(effect.indicator)},
          {"threshold", or_null(effect.threshold)},
          {"seconds", or_null(effect.seconds)},
          {"bound", finite_or_null(effect.bound)},
          {"bound_along", or_null(effect.bound_along)},
          {"bound_together", finite_or_null(effect.bound_together)},
          {"switched_on", finite_or_null(effect.switched_on)},
          {"along_curves", effect.along ? to_json(*effect.along) : Json(nullptr)},
          {"objection", effect.objection}};
}

/// Half widths of value, amplitude, frequency and dissipated energy;
/// null where harmonics are not known, or nothing is.
Json bar_json(const OptimumSummary& summary) {
  const auto& unknown = summary.not_in_bar;
  if (std::ranges::find(unknown, "harmonics") != unknown.end()) return nullptr;
  Json bar = Json::object();
  for (const ErrorRow& row : summary.error_budget) {
    bar[row.goal] = bar_of(summary.error_budget, optimum_name, row.goal);
  }
  if (bar.empty()) return nullptr;
  if (!bar.contains(dissipated_energy_goal)) bar[dissipated_energy_goal] = nullptr;
  bar["not_known"] = unknown;
  bar["left_out"] = to_json(summary.left_out);
  return bar;
}

Json to_json(const OptimumSummary& summary) {
  const solver::Optimum& optimum = summary.optimum;
  Json trace = Json::array();
  for (const solver::PeakOfParameter& peak : optimum.trace) {
    trace.push_back(to_json(peak, summary));
  }
  Json bracket = Json::array();
  for (const OptimumOfFactor& entry : summary.bracket.entries) {
    Json row = to_json(entry.optimum, summary);
    row["parameter"] = entry.parameter;
    row["factor"] = entry.factor;
    row["range"] = entry.range;
    row["range_widened"] = entry.widened;
    if (entry.n_harmonics > 0) row["harmonics"] = entry.n_harmonics;
    bracket.push_back(std::move(row));
  }
  Json json = to_json(optimum, summary);
  json["method"] = "harmonic_balance";
  json["parameter"] = summary.request.key;
  json["message"] = optimum.message;
  json["iterations"] = optimum.iterations;
  json["contact_evaluations"] = optimum.contact_evaluations;
  json["notes"] = optimum.notes;
  json["warnings"] = optimum.warnings;
  json["whole_curves"] = optimum.n_curves;
  json["seconds"] = optimum.seconds;
  json["dissipated_energy_J"] = or_null(summary.dissipated_energy);
  json["bar"] = bar_json(summary);
  json["digits"] = digits_json(json["bar"]);
  json["error_budget"] = to_array(summary.error_budget);
  json["bracket"] = std::move(bracket);
  json["bracket_left_out"] = summary.bracket.left_out;
  json["trace"] = std::move(trace);
  return json;
}

Json libraries_json(const std::vector<std::pair<std::string, std::string>>& libraries) {
  Json json = Json::object();
  for (const auto& [name, version] : libraries) json[name] = version;
  return json;
}

}  // namespace

std::string summary_json(const RunSummary& summary, int indent) {
  const Json json{{"program", "microslip"},
                  {"version", summary.version},
                  {"machine", to_json(summary.machine)},
                  {"libraries", libraries_json(summary.libraries)},
                  {"scene", summary.scene},
                  {"title", summary.title},
                  {"exit_code", static_cast<int>(summary.exit_code)},
                  {"message", summary.message},
                  {"warnings", summary.warnings},
                  {"stages", to_array(summary.stages)},
                  {"mesh", summary.mesh ? to_json(*summary.mesh) : Json(nullptr)},
                  {"modes", to_array(summary.modes)},
                  {"curves", curves_json(summary)},
                  {"optimum", summary.optimum ? to_json(*summary.optimum) : Json(nullptr)},
                  {"effects", to_array(summary.effects)},
                  {"error_budget", to_array(summary.error_budget)},
                  {"accuracy", summary.accuracy ? to_json(*summary.accuracy) : Json(nullptr)}};
  constexpr char space = ' ';
  // A name that is not UTF-8 is written with replacement characters rather than lost with the run.
  return json.dump(indent, space, false, Json::error_handler_t::replace);
}

std::string effects_json(const std::vector<EffectRecord>& effects) {
  return to_array(effects).dump();
}

void write_summary(const std::filesystem::path& file, const RunSummary& summary) {
  std::string text = summary_json(summary) + "\n";
  const std::size_t message = text.find("\n  \"message\": ");
  text.insert(text.find('\n', message + 1), blanks_behind_message, ' ');
  write_whole(file, text);
}

}  // namespace microslip::pipelines
