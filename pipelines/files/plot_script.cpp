#include "pipelines/files/plot_script.hpp"

#include <array>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "pipelines/system/child_process.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// The interpreter the packages of the set-up belong to; another may come first on the PATH.
constexpr const char* python = "/usr/bin/python3";

std::string path_of(const std::string& name) {
  std::error_code code;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", code).parent_path();
  const std::array<std::filesystem::path, 3> folders{
      program / "../../share/scripts",
      program / "../share/microslip/scripts",
      std::filesystem::path(MICROSLIP_SCRIPTS),
  };
  for (const auto& folder : folders) {
    if (std::filesystem::exists(folder / name, code)) {
      return (folder / name).lexically_normal().string();
    }
  }
  throw std::runtime_error(name + " is not installed: looked in " + folders.back().string() +
                           " and beside the program");
}

}  // namespace

std::string run_plot_script(const std::string& name, const std::vector<std::string>& arguments,
                            std::chrono::milliseconds limit) {
  try {
    std::vector<std::string> command{python, path_of(name)};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ChildResult result = run_child(command, limit);
    return result.succeeded ? "" : "not every plot was made: " + result.message;
  } catch (const InterruptedError&) {
    throw;
  } catch (const std::runtime_error& error) {
    return std::string("not every plot was made: ") + error.what();
  }
}

}  // namespace microslip::pipelines
