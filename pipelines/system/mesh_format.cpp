#include "pipelines/system/mesh_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace microslip::pipelines {
namespace {

constexpr std::string_view gmsh_ending = ".msh";
constexpr std::array<std::string_view, 11> converted_endings{
    ".inp", ".bdf", ".nas", ".fem", ".unv", ".med", ".vtu", ".vtk", ".e", ".exo", ".ex2"};

}  // namespace

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_step_file(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".step" || ending == ".stp";
}

bool is_nastran_deck(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".bdf" || ending == ".nas" || ending == ".fem";
}

bool is_punch_file(const std::filesystem::path& file) { return ending_of(file) == ".pch"; }

MeshFormat mesh_format(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (ending == gmsh_ending) return MeshFormat::gmsh;
  const bool known = std::ranges::find(converted_endings, ending) != converted_endings.end();
  return known ? MeshFormat::converted : MeshFormat::unknown;
}

std::string mesh_endings() {
  return fmt::format("{}, {}", gmsh_ending, fmt::join(converted_endings, ", "));
}

std::filesystem::path mesh_beside(const std::filesystem::path& modes) {
  if (modes.extension() == ".med") return modes;
  std::vector<std::string> endings;
  if (modes.extension() == ".frd") endings = {".inp"};
  if (is_punch_file(modes)) endings = {".bdf", ".nas", ".fem"};
  for (const std::string& ending : endings) {
    std::filesystem::path deck = modes;
    deck.replace_extension(ending);
    if (std::filesystem::exists(deck)) return deck;
  }
  return {};
}

}  // namespace microslip::pipelines
