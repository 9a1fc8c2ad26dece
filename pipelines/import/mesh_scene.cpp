#include "pipelines/import/mesh_scene.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipelines/import/mesh_file.hpp"
#include "pipelines/import/mesh_names.hpp"
#include "pipelines/scene/scene_template.hpp"
#include "pipelines/system/mesh_format.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Names = std::vector<MeshName>;
using Words = std::vector<std::string_view>;

constexpr double flat_enough = 0.01;  // of the diameter

/// In quotes, as TOML has it.
std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

bool speaks_of(const std::string& name, const Words& words) {
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return lower.find(word) != lower.npos; });
}

bool is_plane(const MeshName& name) { return name.n_faces > 0 && name.flatness < flat_enough; }

/// A curved face rubs where its name says so; a node set may be the skin of a part of the body.
bool can_rub(const MeshName& name, const Words& words) {
  return is_plane(name) || (name.kind == MeshName::Kind::surface && speaks_of(name.name, words));
}

/// What a key of the scene may be, the likeliest first.
Names candidates(const Names& names, const Words& words,
                 const std::function<bool(const MeshName&)>& possible) {
  Names found;
  for (const MeshName& name : names) {
    const bool is_there =
        std::ranges::any_of(found, [&](const MeshName& other) { return other.name == name.name; });
    if (possible(name) && !is_there) found.push_back(name);
  }
  std::stable_partition(found.begin(), found.end(),
                        [&](const MeshName& name) { return speaks_of(name.name, words); });
  return found;
}

std::string listed(const Names& names) {
  std::string text;
  for (const MeshName& name : names) text += (text.empty() ? "" : ", ") + in_quotes(name.name);
  return text;
}

/// Unit vector along the axis of the largest of three numbers.
std::string axis_of_largest(const Eigen::Vector3d& numbers) {
  Eigen::Index axis = 0;
  numbers.maxCoeff(&axis);
  const Eigen::Vector3i unit = Eigen::Vector3i::Unit(axis);
  return fmt::format("[{}, {}, {}]", unit.x(), unit.y(), unit.z());
}

class SceneMaker {
 public:
  SceneMaker(const MeshOfFile& read, const std::filesystem::path& file)
      : read_(read), names_(mesh_names(read.mesh)), extent_(read.mesh.upper() - read.mesh.lower()) {
    extent_.maxCoeff(&span_);
    set_unit(file);
  }

  void set_file(const char* key, const std::filesystem::path& file,
                const std::filesystem::path& scene_folder) {
    const auto relative = std::filesystem::relative(file, scene_folder);
    values_[key] = in_quotes((relative.empty() ? file : relative).string());
  }

  void set(const char* key, std::string value) { values_[key] = std::move(value); }
  void remark(const char* key, std::string text) { remarks_[key] = std::move(text); }

  /// @throws SceneError  the mesh names nothing.
  std::string make(std::string_view kind) {
    if (names_.empty()) {
      throw SceneError(
          "the mesh names no surface and no set of nodes, so that nothing can be held or rub: name "
          "them in the file; how each format does that stands in share/doc/meshes.md");
    }
    choose_support();
    choose_contact();
    choose_points();
    if (kind == "modes") {  // which are of a body that is held
      values_.erase("supports.clamped");
      remarks_.erase("supports.clamped");
      write_unit();
    }
    std::string text = "# What the mesh has:\n";
    std::istringstream table(describe_names(read_.mesh, read_.length_unit));
    for (std::string line; std::getline(table, line);) text += "#   " + line + '\n';
    text += scene_template(kind, values_, remarks_);
    return has_contact_ ? text : without_contact(text);
  }

 private:
  void set_unit(const std::filesystem::path& file) {
    constexpr double longest = 3.0;  // m
    const bool is_gmsh = mesh_format(file) == MeshFormat::gmsh;
    const bool is_salome = file.extension() == ".unv" && read_.length_unit == 1.0;
    if (is_salome && extent_.maxCoeff() > longest) {
      unit_ = "mm";
      values_["model.length_unit"] = in_quotes(unit_);
      remarks_["model.length_unit"] = fmt::format(
          "CHECK: the file says metre, as Salome writes whatever it draws in; in metres the mesh "
          "is {:.3g} m long",
          extent_.maxCoeff());
      return;
    }
    if (read_.length_unit) {
      values_["model.length_unit"] = "";  // the file tells it
      return;
    }
    unit_ = extent_.maxCoeff() < longest ? "m" : "mm";
    values_["model.length_unit"] = in_quotes(unit_);
    remarks_["model.length_unit"] =
        fmt::format("{}the file does not tell it: chosen by the size, which is {}",
                    is_gmsh ? "" : "CHECK: ", size_readings(read_.mesh));
  }

  /// The file of the modes is in the unit of the mesh, and says none itself.
  void write_unit() {
    if (!read_.length_unit || !values_["model.length_unit"].empty()) return;
    constexpr std::array<std::pair<double, const char*>, 4> known{
        {{1.0, "m"}, {1e-3, "mm"}, {1e-2, "cm"}, {0.0254, "in"}}};
    const auto named = std::ranges::find_if(known, [&](const auto& unit) {
      return std::abs(*read_.length_unit / unit.first - 1.0) < 1e-9;
    });
    values_["model.length_unit"] =
        named != known.end() ? in_quotes(named->second) : fmt::format("{}", *read_.length_unit);
    remarks_["model.length_unit"] = "as the mesh says";
  }

  void choose_support() {
    const Words words{"root", "fix", "clamp", "held", "hold", "support", "foot", "spc", "encastre"};
    const Names possible = candidates(
        names_, words, [](const MeshName& name) { return name.n_nodes >= 3 || name.n_faces > 0; });
    const bool is_told = !possible.empty() && speaks_of(possible.front().name, words);
    const MeshName* held = is_told ? &possible.front() : larger_end(possible);
    if (held != nullptr) {
      clamped_ = held->name;
      held_at_ = held->centre;
    }
    values_["supports.clamped"] = clamped_.empty() ? "[]" : "[" + in_quotes(clamped_) + "]";
    if (!is_told) {
      remarks_["supports.clamped"] =
          fmt::format("CHOOSE what is held: no name tells it{}; there are: {}",
                      clamped_.empty() ? "" : ", here the larger plane end of the longest side",
                      possible.empty() ? "none" : listed(possible));
    } else if (possible.size() > 1) {
      remarks_["supports.clamped"] = "or some of: " + listed(possible);
    }
  }

  /// The larger of the plane surfaces at the ends of the longest side; nullptr: there is none.
  [[nodiscard]] const MeshName* larger_end(const Names& names) const {
    const MeshName* best = nullptr;
    for (const MeshName& name : names) {
      const double x = name.centre[span_];
      const double off = std::min(x - read_.mesh.lower()[span_], read_.mesh.upper()[span_] - x);
      if (!is_plane(name) || off > 1e-3 * extent_[span_]) continue;
      if (best == nullptr || name.area > best->area) best = &name;
    }
    return best;
  }

  void choose_contact() {
    const Words words{"contact", "rub", "fric", "slave", "damper", "shroud", "platform", "pload"};
    Names possible = candidates(names_, words, [&](const MeshName& name) {
      return can_rub(name, words) && name.name != clamped_;
    });
    std::stable_partition(possible.begin(), possible.end(), [&](const MeshName& name) {
      return is_plane(name) && speaks_of(name.name, words);
    });
    const bool is_told = !possible.empty() && speaks_of(possible.front().name, words);
    if (!is_told) {  // what lies along the blade rather than its end
      std::stable_partition(possible.begin(), possible.end(), [&](const MeshName& name) {
        return std::abs(name.normal[span_]) < 0.2;
      });
    }
    has_contact_ = !possible.empty();
    if (!has_contact_) {
      for (const char* key : {"response.preload", "response.maps"}) values_[key] = "";
      return;
    }
    const MeshName& chosen = possible.front();
    contact_ = chosen.name;
    values_["contact.surface"] = in_quotes(contact_);
    if (possible.size() > 1) {
      remarks_["contact.surface"] =
          (is_told ? "or another of: " : "CHOOSE: no name tells it; plane ones: ") +
          listed(possible);
    }
    // In the face; of two axes in it that along which the blade is longer.
    const Eigen::Vector3d in_face = Eigen::Vector3d::Ones() - chosen.normal.cwiseAbs();
    values_["contact.slip_direction"] =
        axis_of_largest(in_face + 1e-3 * extent_ / extent_.maxCoeff());
  }

  void choose_points() {
    const auto elsewhere = [&](const MeshName& name) {
      return name.n_nodes > 0 && name.name != clamped_;
    };
    Names possible = candidates(names_, {}, elsewhere);
    // A force where the contact is moves little: what is far from the support comes first, the
    // contact last.
    std::ranges::stable_sort(possible, [&](const MeshName& a, const MeshName& b) {
      return likelihood_of_force(a) > likelihood_of_force(b);
    });
    const std::string otherwise = possible.empty() || possible.front().name == contact_
                                      ? farthest_node()
                                      : in_quotes(possible.front().name);
    const auto place = [&](const Words& words) {  // "PLOAD4 1" is a contact by its "load"
      const auto told = first_with(possible, words, contact_);
      return told ? in_quotes(*told) : otherwise;
    };
    const std::string force = place({"force", "load", "excit"});
    const std::string output = place({"output", "respon", "sensor", "tip"});
    const std::string bends = axis_of_largest(-extent_);  // a blade bends where it is thin
    values_["excitation.forces"] = fmt::format(
        "[\n  {{ at = {}, direction = {}, amplitude = \"1 N\", phase = \"0 deg\" }},\n]", force,
        bends);
    values_["response.output"] = fmt::format("{{ at = {}, direction = {} }}", output, bends);
    for (const char* key : {"excitation.forces", "response.output"}) {
      remarks_[key] = "at coordinates, which mean the nearest node" +
                      (possible.empty() ? "" : ", or at one of: " + listed(possible));
    }
    remarks_["response.frequency"] = "CHANGE: `microslip modes` tells the natural frequencies";
  }

  /// Points as the file has them, then the distance from what is held.
  [[nodiscard]] double likelihood_of_force(const MeshName& name) const {
    if (name.kind == MeshName::Kind::point) return std::numeric_limits<double>::infinity();
    if (name.name == contact_) return -1.0;
    return (name.centre - held_at_).norm();
  }

  /// Coordinates of the node farthest from what is held.
  [[nodiscard]] std::string farthest_node() const {
    Eigen::Index node = 0;
    (read_.mesh.nodes().rowwise() - held_at_.transpose()).rowwise().squaredNorm().maxCoeff(&node);
    const auto one = [&](int axis) {
      return fmt::format("\"{:.6g} {}\"", read_.mesh.nodes()(node, axis), unit_);
    };
    return fmt::format("[{}, {}, {}]", one(0), one(1), one(2));
  }

  static std::optional<std::string> first_with(const Names& names, const Words& words,
                                               const std::string& but) {
    const auto found = std::ranges::find_if(names, [&](const MeshName& name) {
      return name.name != but && speaks_of(name.name, words);
    });
    return found == names.end() ? std::nullopt : std::optional<std::string>(found->name);
  }

  /// The section in comments.
  static std::string without_contact(const std::string& text) {
    std::istringstream lines(text);
    std::string result;
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("[")) inside = line == "[contact]";
      if (line == "[contact]") result += "# No name holds a plane face, so that nothing rubs.\n";
      result += (inside && !line.empty() && line[0] != '#' ? "# " : "") + line + '\n';
    }
    return result;
  }

  const MeshOfFile& read_;
  Names names_;
  Eigen::Vector3d extent_;
  TemplateTexts values_;
  TemplateTexts remarks_;
  Eigen::Index span_ = 0;   // axis of the longest side
  std::string unit_ = "m";  // of the coordinates
  std::string clamped_, contact_;
  Eigen::Vector3d held_at_ = Eigen::Vector3d::Zero();
  bool has_contact_ = false;
};

}  // namespace

std::string scene_of_mesh(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const MeshOfFile read = read_mesh(file, std::nullopt);
  require_whole(read);
  SceneMaker maker(read, file);
  maker.set_file("model.file", file, folder);
  maker.set("model.order", mesh::is_quadratic(read.mesh.elements().front().type) ? "2" : "1");
  return maker.make("mesh");
}

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> meshes_in(const fs::path& folder, bool of_punch) {
  std::vector<fs::path> meshes;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const bool fits = of_punch ? is_nastran_deck(file) : mesh_format(file) != MeshFormat::unknown;
    if (entry.is_regular_file() && fits) meshes.push_back(file);
  }
  std::ranges::sort(meshes);
  return meshes;
}

/// The only one of several meshes with the name of `file`; "": there is none, or more.
fs::path of_one_name(const std::vector<fs::path>& meshes, const fs::path& file) {
  std::vector<fs::path> fitting;
  std::ranges::copy_if(meshes, std::back_inserter(fitting),
                       [&](const fs::path& mesh) { return mesh.stem() == file.stem(); });
  return fitting.size() == 1 ? fitting.front() : fs::path();
}

/// Of modes or of a stiffness, where none is named.
fs::path mesh_of(const fs::path& file) {
  if (const fs::path deck = mesh_beside(file); !deck.empty()) return deck;
  const bool is_stiffness = file.extension() == ".mtx";
  const fs::path own = fs::absolute(file).parent_path();
  for (const fs::path& folder : {own, own.parent_path()}) {
    if (folder != own && !is_stiffness) break;
    const std::vector<fs::path> meshes = meshes_in(folder, is_punch_file(file));
    if (meshes.empty()) continue;
    if (meshes.size() == 1) return meshes.front();
    if (const fs::path named = of_one_name(meshes, file); !named.empty()) return named;
    throw SceneError(
        fmt::format("{0}: which is its mesh? In {1} are {2} and {3}{4}; name it: `microslip init "
                    "modes {0} {5}`",
                    file.string(), folder.string(), meshes[0].filename().string(),
                    meshes[1].filename().string(), meshes.size() > 2 ? ", …" : "",
                    fs::relative(meshes[0]).string()));
  }
  throw SceneError(fmt::format(
      "{0}: no mesh lies beside it{1}; put there the one file that has the names, or name "
      "it: `microslip init modes {0} MESH`{2}",
      file.string(), is_stiffness ? ", nor in the folder above" : "",
      is_punch_file(file) ? ". Of a punched file it is the deck" : ""));
}

/// `stiffness` with mass.mtx and nodes.csv beside it.
std::string scene_of_matrices(const fs::path& stiffness, const fs::path& mesh,
                              const fs::path& folder) {
  const fs::path mass = stiffness.parent_path() / "mass.mtx";
  const fs::path nodes = stiffness.parent_path() / "nodes.csv";
  for (const fs::path& needed : {mass, nodes}) {
    if (fs::exists(needed) && fs::equivalent(needed, stiffness)) {
      throw SceneError(fmt::format("{}: is the mass; begin with the stiffness that lies beside it",
                                   stiffness.string()));
    }
    if (fs::exists(needed)) continue;
    throw SceneError(fmt::format(
        "{}: {} does not lie beside it; a stiffness goes with mass.mtx and nodes.csv (for "
        "CalculiX share/scripts/calculix_matrices.py writes all three)",
        stiffness.string(), needed.filename().string()));
  }
  const fs::path own = mesh.empty() ? mesh_of(stiffness) : mesh;
  const MeshOfFile read = read_mesh(own, std::nullopt);
  SceneMaker maker(read, own);
  maker.set("model.file", "");
  maker.set_file("model.stiffness", stiffness, folder);
  maker.set_file("model.mass", mass, folder);
  maker.set_file("model.nodes", nodes, folder);
  maker.set_file("model.mesh", own, folder);
  maker.set("modes.count", "10");
  maker.set("modes.residual", "\"attachment\"");
  return maker.make("modes");
}

}  // namespace

std::string scene_of_modes(const std::filesystem::path& file, const std::filesystem::path& mesh,
                           const std::filesystem::path& folder) {
  if (!std::filesystem::exists(file)) throw SceneError(file.string() + ": no such file");
  if (!mesh.empty() && mesh_format(mesh) == MeshFormat::unknown) {
    throw SceneError(fmt::format("{}: meshes are read from files that end in {}", mesh.string(),
                                 mesh_endings()));
  }
  if (file.extension() == ".mtx") return scene_of_matrices(file, mesh, folder);
  const std::filesystem::path own = mesh.empty() ? mesh_of(file) : mesh;
  if (is_punch_file(file) && !is_nastran_deck(own)) {
    throw SceneError(fmt::format(
        "{}: a punched file tells nodes by their numbers: expected the deck these modes were "
        "computed with (.bdf, .nas, .fem), not {}",
        file.string(), own.string()));
  }
  const MeshOfFile read = read_mesh(own, std::nullopt);
  SceneMaker maker(read, own);
  maker.set_file("model.file", file, folder);
  maker.set_file("model.mesh", own, folder);
  maker.remark("material.density", "CHECK: that of the body; by it the modal masses are checked");
  return maker.make("modes");
}

}  // namespace microslip::pipelines
