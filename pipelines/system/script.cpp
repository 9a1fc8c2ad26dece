#include "pipelines/system/script.hpp"

#include <array>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// The interpreter the packages of the set-up belong to; another may come first on the PATH.
constexpr const char* python = "/usr/bin/python3";

}  // namespace

std::vector<std::string> script_command(const std::string& name) {
  std::error_code code;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", code).parent_path();
  const std::array<std::filesystem::path, 3> folders{
      program / "../../share/scripts",
      program / "../share/microslip/scripts",
      std::filesystem::path(MICROSLIP_SCRIPTS),
  };
  for (const auto& folder : folders) {
    if (std::filesystem::exists(folder / name, code) &&
        std::filesystem::exists(folder / "../python/microslip", code)) {
      return {python, (folder / name).lexically_normal().string()};
    }
  }
  throw SceneError(fmt::format(
      "a part of microslip is missing, {} or the Python package that it needs: they are expected "
      "in {} and {}; copy the folder share of the source there",
      name, folders.back().string(),
      (folders.back() / "../python/microslip").lexically_normal().string()));
}

}  // namespace microslip::pipelines
