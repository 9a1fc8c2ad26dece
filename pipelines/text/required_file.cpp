#include "pipelines/text/required_file.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipelines/system/scene_error.hpp"
#include "pipelines/text/nearest_name.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

/// Names in a folder of files that end alike, in order.
std::vector<std::string> names_beside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(file.parent_path(), error)) {
    if (entry.path().extension() == file.extension()) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

std::string remedy(const fs::path& file) {
  std::error_code error;
  if (!fs::is_directory(file.parent_path(), error)) {
    return fmt::format("there is no folder {}", file.parent_path().string());
  }
  std::vector<std::string> names = names_beside(file);
  if (names.empty()) {
    return fmt::format("no file in {} ends in {}", file.parent_path().string(),
                       file.extension().string());
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near = nearest_name(file.filename().string(), known);
  if (!near.empty()) return fmt::format("did you mean \"{}\"?", near);
  constexpr std::size_t longest_list = 5;
  const std::size_t n = names.size();
  names.resize(std::min(n, longest_list));
  return fmt::format("beside it: {}{}", fmt::join(names, ", "), n > longest_list ? ", …" : "");
}

}  // namespace

void require_file(const std::filesystem::path& file, const std::string& place) {
  std::error_code error;
  if (fs::exists(file, error)) return;
  throw SceneError(fmt::format("{}: {}: no such file; {}", place, file.string(), remedy(file)));
}

}  // namespace microslip::pipelines
