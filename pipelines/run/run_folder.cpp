#include "pipelines/run/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

/// What a run writes and the next one removes: it would stand beside new files and be taken for theirs.
constexpr std::array result_names{"curves",
                                  "maps",
                                  "motion",
                                  "plots",
                                  "modes.csv",
                                  "modes.vtu",
                                  "model.h5",
                                  "report.md",
                                  "summary.json",
                                  "peak_against_preload.csv",
                                  "peak_against_parameter.csv"};

}  // namespace

int lock_folder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".lock";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) throw ExhaustedError("cannot write in " + folder.string());
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    throw ExhaustedError("another run is writing in " + folder.string() + "; choose another -o");
  }
  return descriptor;
}

void require_own(const std::filesystem::path& folder) {
  const auto holds = [&](const char* name) { return std::filesystem::exists(folder / name); };
  if (holds("scene.toml") && holds("log.txt")) return;
  std::vector<const char*> names(result_names.begin(), result_names.end());
  names.push_back("scene.toml");
  for (const char* name : names) {
    if (!holds(name)) continue;
    throw SceneError(
        fmt::format("-o {}: holds \"{}\", which no run has written and a run would replace; "
                    "choose another folder",
                    folder.string(), name));
  }
}

void clear_results(const std::filesystem::path& folder) {
  for (const char* name : result_names) {
    std::error_code ignored;  // what cannot be removed cannot be written either: said there
    std::filesystem::remove_all(folder / name, ignored);
  }
}

}  // namespace microslip::pipelines
