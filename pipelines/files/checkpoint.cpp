#include "pipelines/files/checkpoint.hpp"

#include <map>
#include <sstream>
#include <system_error>
#include <tuple>

#include <fmt/format.h>

#include "pipelines/files/result_members.hpp"
#include "pipelines/structure/structure_members.hpp"
#include "pipelines/system/byte_archive.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/sealed_bytes.hpp"
#include "pipelines/text/json_entry.hpp"

namespace fs = std::filesystem;

namespace microslip::pipelines {
namespace {

/// First line of a part: another version, or another layout of what it holds, is refused by it.
std::string header() {
  return fmt::format("microslip {} checkpoint {}.{}.{}", MICROSLIP_VERSION,
                     sizeof(solver::ResponseCurve), sizeof(CurveResult), sizeof(StructureModes));
}

/// The values of a completed scene by their path; repeated sections are numbered, and so are the
/// lines of a list that has several.
std::map<std::string, std::string> values_of(const std::string& scene_toml) {
  std::map<std::string, std::string> values;
  std::map<std::string, int> repeated;
  std::string section;
  std::string list;  // whose lines are read
  int n_lines = 0;
  std::istringstream lines(scene_toml);
  for (std::string line; std::getline(lines, line);) {
    if (!list.empty() && line.starts_with(" ")) {
      const std::size_t begin = line.find_first_not_of(' ');
      const std::size_t end = line.find_last_not_of(", ");
      values[fmt::format("{}[{}]", list, n_lines++)] = line.substr(begin, end + 1 - begin);
      continue;
    }
    list.clear();
    if (line.starts_with("[[")) {
      section = line.substr(2, line.find(']') - 2);
      section += fmt::format("[{}].", ++repeated[section]);
    } else if (line.starts_with("[")) {
      section = line.substr(1, line.find(']') - 1) + ".";
    } else if (const auto equals = line.find(" = "); equals != std::string::npos) {
      const std::string key = section + line.substr(0, equals);
      if (line.ends_with(" [")) {
        list = key;
        n_lines = 0;
      } else {
        values[key] = line.substr(equals + 3);
      }
    }
  }
  return values;
}

void require_same_scene(const fs::path& file, const std::string& before, const std::string& now) {
  if (before == now) return;
  const auto there = values_of(before);
  auto here = values_of(now);
  here.insert(there.begin(), there.end());  // the keys of both
  const auto given = values_of(now);
  const auto shown = [](const auto& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string("not given") : found->second;
  };
  for (const auto& [key, ignored] : here) {
    if (shown(there, key) == shown(given, key)) continue;
    throw SceneError(fmt::format(
        "--resume: {} is {}, but {} in {}, the scene the run began with; run without --resume, or "
        "choose another -o",
        key, shown(given, key), shown(there, key), file.string()));
  }
  throw SceneError(fmt::format("--resume: {} is not the scene that is given", file.string()));
}

}  // namespace

std::uint64_t fingerprint_of(const mesh::Mesh& mesh) {
  ByteWriter bytes;
  bytes(mesh.nodes());
  for (const mesh::ElementBlock& block : mesh.elements()) bytes(block.connectivity);
  for (const auto& names : {mesh.surface_names(), mesh.node_set_names()}) {
    for (const std::string& name : names) {
      bytes(name);
      bytes(mesh.node_set(name));
    }
  }
  return fingerprint(bytes.bytes());
}

std::uint64_t fingerprint_of(const fs::path& file) { return fingerprint(bytes_of(file)); }

std::vector<fs::path> files_of_structure(const SceneDescription& scene) {
  if (const auto* step = std::get_if<StepModel>(&scene.model)) return {step->file};
  const auto* mesh = std::get_if<MeshFileModel>(&scene.model);
  if (mesh == nullptr) return {};
  std::vector<fs::path> files{mesh->file};
  if (mesh->modes) files.push_back(mesh->modes->file);
  if (const auto& matrices = mesh->matrices) {
    files.insert(files.end(), {matrices->stiffness, matrices->mass, matrices->nodes});
  }
  return files;
}

bool is_begun(const fs::path& folder) { return fs::exists(folder / "checkpoint" / "scene.toml"); }

Checkpoint::Checkpoint(const fs::path& run, bool resumed)
    : folder_(run / "checkpoint"), resumed_(resumed) {}

void Checkpoint::begin(const std::string& scene_toml) {
  if (resumed_) return;
  end();
  make_folder(folder_ / "curves");
  write_whole(folder_ / "scene.toml", scene_toml);
}

void Checkpoint::forget_parts() {
  std::error_code ignored;  // a leftover is found by the next run, which forgets it
  for (const char* part : {"curves", "inputs", "mesh", "modes", "model"}) {
    fs::remove_all(folder_ / part, ignored);
  }
}

void Checkpoint::end() {
  std::error_code ignored;
  fs::remove(folder_ / "scene.toml", ignored);
  forget_parts();
}

template <typename Part>
std::optional<Part> Checkpoint::find(const std::string& name) const {
  const fs::path file = folder_ / name;
  if (!resumed_ || !fs::exists(file)) return std::nullopt;
  const std::string content = bytes_of(file);
  const Unsealed kept = unsealed(header(), content);
  const auto refuse = [&](const std::string& why) {
    return SceneError(fmt::format("{}: {}; run without --resume", file.string(), why));
  };
  if (!kept.fault.empty()) throw refuse(kept.fault);
  try {
    ByteReader reader(kept.bytes);
    std::optional<Part> part(std::in_place);
    reader(*part);
    return part;
  } catch (const std::out_of_range&) {
    throw refuse("damaged");
  }
}

template <typename Part>
void Checkpoint::keep(const std::string& name, const Part& part) const {
  ByteWriter values;
  values(part);
  write_whole(folder_ / name, sealed(header(), values.bytes()));
}

void Checkpoint::require_same(const std::string& name, std::uint64_t value,
                              const std::string& what) const {
  const auto before = find<std::uint64_t>(name);
  if (!before) return keep(name, value);
  if (*before != value) {
    throw SceneError(fmt::format(
        "--resume: {} is not that of the run that was begun: a file that the scene names, or the "
        "number of BLAS threads, has changed; run without --resume, or choose another -o",
        what));
  }
}

template std::optional<std::uint64_t> Checkpoint::find(const std::string&) const;
template std::optional<StructureModes> Checkpoint::find(const std::string&) const;
template std::optional<CurveResult> Checkpoint::find(const std::string&) const;
template void Checkpoint::keep(const std::string&, const StructureModes&) const;
template void Checkpoint::keep(const std::string&, const CurveResult&) const;

std::optional<int> ended_run(const fs::path& folder, const std::string& scene_toml) {
  const fs::path begun = folder / "checkpoint" / "scene.toml";
  const fs::path summary = folder / "summary.json";
  if (is_begun(folder)) {
    require_same_scene(begun, bytes_of(begun), scene_toml);
    return std::nullopt;
  }
  const fs::path ended = folder / "scene.toml";
  if (fs::exists(folder / "checkpoint" / "summary.json"))
    return std::nullopt;  // killed before it began
  if (!fs::exists(summary) || !fs::exists(ended)) {
    throw SceneError(fmt::format(
        "--resume: {} holds no run; leave --resume out to begin one, or name its folder with -o",
        folder.string()));
  }
  require_same_scene(ended, bytes_of(ended), scene_toml);
  const auto document = parse_json(bytes_of(summary), summary.string());
  const JsonEntry told(document, summary.string());  // of one that failed since, or its own
  return static_cast<int>((told.has("earlier") ? told.at("earlier") : told).integer("exit_code"));
}

}  // namespace microslip::pipelines
