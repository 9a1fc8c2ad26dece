#include "pipelines/stages/kept_results.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "pipelines/files/checkpoint.hpp"
#include "pipelines/files/model_file.hpp"
#include "pipelines/files/model_members.hpp"
#include "pipelines/files/result_members.hpp"
#include "pipelines/model/curve_load.hpp"
#include "pipelines/system/byte_archive.hpp"
#include "pipelines/system/deadline.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/result_cache.hpp"
#include "pipelines/text/toml_text.hpp"

namespace microslip::pipelines {

auto members(Is<CurveBudget> auto& value) {
  auto& [rows, unknown, left_out, no_bound, touches, dissipated_energy, energy_ratio, along] =
      value;
  return std::tie(rows, unknown, left_out, no_bound, touches, dissipated_energy, energy_ratio,
                  along);
}
auto members(Is<PictureFile> auto& value) {
  auto& [name, bytes] = value;
  return std::tie(name, bytes);
}
auto members(Is<Pictures> auto& value) {
  auto& [maps, files] = value;
  return std::tie(maps, files);
}
auto members(Is<BestValue> auto& value) {
  auto& [optimum, budget, bracket] = value;
  return std::tie(optimum, budget, bracket);
}

namespace {

/// So many evaluations of a point take some tenth of a second. Counted, not measured: which results
/// are kept does not depend on the day.
constexpr double worth_keeping = 1e4;
constexpr std::size_t bytes_worth_keeping = 1'000'000;  ///< of pictures, likewise

using Keys = std::vector<std::string_view>;

/// What is drawn of a solution changes nothing of it.
bool is_of_maps(const std::string& section, const std::string& key) {
  return section == "[effects]" && (key == "maps" || key == "wear");
}

/// Lines of a completed scene by section and key.
template <typename Which>
std::string lines_where(const std::string& scene_toml, const Which& which) {
  std::string text;
  std::string section;
  std::istringstream lines(scene_toml);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) section = line;
    if (which(section, line.substr(0, line.find(" = ")))) text += line + '\n';
  }
  return text;
}

/// A completed scene without its title, these keys of [response], what says whether maps are drawn,
/// and [accuracy], of which the settings of the model say more.
std::string text_without(const Keys& keys, const std::string& scene_toml) {
  return lines_where(scene_toml, [&](const std::string& section, const std::string& key) {
    const bool is_choice = section == "[response]" && std::ranges::find(keys, key) != keys.end();
    const bool is_title = section.empty() && key == "title";
    const bool says_more = section != "[accuracy]" && !is_of_maps(section, key);
    return says_more && !is_choice && !is_title;
  });
}

/// Which maps are drawn, and of what.
std::string text_of_maps(const std::string& scene_toml) {
  return lines_where(scene_toml, [](const std::string& section, const std::string& key) {
    return is_of_maps(section, key) || (section == "[response]" && key.starts_with("map"));
  });
}

/// Adds the content of every file that a part of a completed scene names, which has whole paths.
void add_files(const toml::node& node, ByteWriter& bytes) {
  if (const auto* text = node.as_string()) {
    const std::filesystem::path path = text->get();
    std::error_code none;  // a text that is no name of a file
    if (path.is_absolute() && std::filesystem::is_regular_file(path, none)) {
      bytes(fingerprint_of(path));
    }
  } else if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) add_files(value, bytes);
  } else if (const auto* list = node.as_array()) {
    for (const toml::node& value : *list) add_files(value, bytes);
  }
}

/// The model does not say all of them: stiffness of the points and of the bodies in series with it,
/// a table between the contact points.
std::string files_of(const SceneDescription& scene) {
  ByteWriter bytes;
  add_files(parse_toml(scene.complete_toml, scene.file.string()), bytes);
  return bytes.bytes();
}

std::string settings_of(const ReducedModel& model, const SceneDescription& scene) {
  ByteWriter bytes;
  bytes(arrays_of(model));
  bytes(model.effects);
  bytes(model.coordinates);
  bytes(scene.settings.harmonics);
  bytes(scene.settings.second_direction);
  return bytes.bytes();
}

bool is_whole() { return !interrupt_requested() && !was_cut_short(); }

template <typename Part>
std::optional<Part> found(std::string_view kind, const std::string& inputs) {
  const ResultCache* cache = ResultCache::in_use();
  if (cache == nullptr) return std::nullopt;
  const auto bytes = cache->kept(kind, inputs);
  if (!bytes) return std::nullopt;
  try {
    std::optional<Part> part(std::in_place);
    ByteReader reader(*bytes);
    reader(*part);
    return part;
  } catch (const std::out_of_range&) {  // whole, and yet not what this program writes
    return std::nullopt;
  }
}

template <typename Part>
void keep_part(const std::string& kind, const std::string& inputs, const Part& part) {
  ResultCache* cache = ResultCache::in_use();
  if (cache == nullptr || !is_whole()) return;
  ByteWriter bytes;
  bytes(part);
  cache->entry(kind, inputs).keep(bytes.bytes());
}

std::string with_load(const std::string& inputs, const std::variant<double, LimitName>& load) {
  ByteWriter bytes;
  bytes(load);
  return inputs + bytes.bytes();
}

std::string maps_name(const CurveResult& curve) { return "maps_" + curve.name; }

std::string errors_name(const CurveResult& curve) { return "errors_" + curve.name; }

/// Another beginning may end in other points, within what they are solved to.
std::string with_begin(const std::string& inputs, const solver::ResponseCurve* near) {
  if (near == nullptr || near->points.empty()) return inputs;
  ByteWriter bytes;
  bytes(near->points.front().q);
  return inputs + bytes.bytes();
}

/// Errors are those of these points, whatever they took.
std::string with_points(const std::string& inputs, const CurveResult& curve) {
  ByteWriter bytes;
  bytes(curve.richer.has_value());  // not where its time was over before
  for (const solver::ResponsePoint& point : curve.curve.points) bytes(point.q);
  return with_load(inputs, curve.load) + bytes.bytes();
}

}  // namespace

KeptResults::KeptResults(const ReducedModel& model, const SceneDescription& scene) : model_(model) {
  for (const contact::Patch& patch : model.patches) {
    n_points_ += static_cast<double>(patch.cells.size());
  }
  if (ResultCache::in_use() == nullptr) return;
  const std::string settings = settings_of(model, scene) + files_of(scene);
  Keys keys{"maps", "map_phases"};
  // Bounds of a search that are not given are those of the list.
  if (scene.response->optimum && scene.response->optimum->range) keys.emplace_back("preload");
  const std::string errors = scene.accuracy.error_budget ? "with errors" : "without errors";
  best_ = text_without(keys, scene.complete_toml) + settings + errors;
  for (const char* key : {"preload", "preload_scale", "limits", "optimum", "optimum_range",
                          "optimum_at", "time_budget"}) {
    keys.emplace_back(key);
  }
  curves_ = text_without(keys, scene.complete_toml) + settings;
  maps_ = text_of_maps(scene.complete_toml);
}

bool KeptResults::is_worth(long evaluations) const {
  return static_cast<double>(evaluations) * n_points_ >= worth_keeping;
}

std::optional<CurveResult> KeptResults::curve(const CurveRequest& request,
                                              const solver::ResponseCurve* near) const {
  return found<CurveResult>(request.name,
                            with_begin(with_load(curves_, load_of(request, model_)), near));
}

void KeptResults::keep(const CurveResult& curve, const solver::ResponseCurve* near) const {
  const bool ended = curve.curve.diagnosis != solver::Diagnosis::budget;  // of time, or of points
  if (!ended || !is_worth(curve.curve.contact_evaluations)) return;
  keep_part(curve.name, with_begin(with_load(curves_, curve.load), near), curve);
}

std::optional<CurveBudget> KeptResults::budget(const CurveResult& curve) const {
  return found<CurveBudget>(errors_name(curve), with_points(curves_, curve));
}

void KeptResults::keep(const CurveBudget& budget, const CurveResult& curve) const {
  if (!is_worth(curve.curve.contact_evaluations)) return;
  keep_part(errors_name(curve), with_points(curves_, curve), budget);
}

std::optional<Pictures> KeptResults::pictures(const CurveResult& curve) const {
  return found<Pictures>(maps_name(curve), with_points(maps_ + curves_, curve));
}

void KeptResults::keep(const Pictures& pictures, const CurveResult& curve) const {
  std::size_t n_bytes = 0;
  for (const PictureFile& file : pictures.files) n_bytes += file.bytes.size();
  if (n_bytes < bytes_worth_keeping) return;
  keep_part(maps_name(curve), with_points(maps_ + curves_, curve), pictures);
}

std::optional<BestValue> KeptResults::best_value() const {
  return found<BestValue>("best_value", best_);
}

void KeptResults::keep(const BestValue& best) const {
  if (!is_worth(best.optimum.contact_evaluations)) return;
  keep_part("best_value", best_, best);
}

}  // namespace microslip::pipelines
