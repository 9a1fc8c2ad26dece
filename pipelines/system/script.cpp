#include "pipelines/system/script.hpp"

#include <array>
#include <filesystem>
#include <stdexcept>
#include <system_error>

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
    if (std::filesystem::exists(folder / name, code)) {
      return {python, (folder / name).lexically_normal().string()};
    }
  }
  throw std::runtime_error(name + " is not installed: looked in " + folders.back().string() +
                           " and beside the program");
}

}  // namespace microslip::pipelines
