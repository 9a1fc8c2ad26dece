#include "mesh/mesher_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "mesh/mesh_error.hpp"

extern char** environ;  // NOLINT: POSIX names it so

namespace microslip::mesh {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// Beside the running program, or one level up in bin/ (tests); MICROSLIP_MESHER overrides.
fs::path mesher_program() {
  if (const char* given = std::getenv("MICROSLIP_MESHER")) return given;
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& candidate :
       {here / "microslip-mesher", here.parent_path() / "bin" / "microslip-mesher"}) {
    if (fs::exists(candidate, error)) return candidate;
  }
  throw MeshError("the program microslip-mesher is not beside microslip; build all targets");
}

std::string parameters(const BladeGeometry& g, double element_size) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << "element_size " << element_size << "\nroot_width " << g.root_width << "\nroot_height "
       << g.root_height << "\nroot_length " << g.root_length << "\nplatform_width "
       << g.platform_width << "\nplatform_height " << g.platform_height << "\nplatform_length "
       << g.platform_length << "\nspan " << g.span << "\nroot_chord " << g.root_chord
       << "\ntip_chord " << g.tip_chord << "\nroot_thickness " << g.root_thickness
       << "\ntip_thickness " << g.tip_thickness << "\nroot_stagger " << g.root_stagger
       << "\ntip_stagger " << g.tip_stagger << "\ncamber " << g.camber << "\nlean " << g.lean
       << '\n';
  return text.str();
}

/// Removes its file when it goes.
class ScratchFile {
 public:
  explicit ScratchFile(fs::path path) : path_(std::move(path)) {}
  ~ScratchFile() {
    std::error_code ignored;  // gone already, or renamed
    fs::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ScratchFile(ScratchFile&&) = delete;
  ScratchFile& operator=(ScratchFile&&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Last lines a file holds, on one line.
std::string tail_of(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  std::string all = text.str();
  while (!all.empty() && (all.back() == '\n' || all.back() == '\r')) all.pop_back();
  constexpr std::size_t most = 600;
  if (all.size() > most) all = "…" + all.substr(all.size() - most);
  return all;
}

pid_t start(const fs::path& program, const fs::path& input, const fs::path& output,
            const fs::path& messages, double memory_mb) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, messages.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::string name = program.string();
  std::string file = output.string();
  std::string memory = std::to_string(memory_mb);
  std::array<char*, 4> arguments{name.data(), file.data(), memory.data(), nullptr};
  pid_t child = 0;
  const int error =
      posix_spawn(&child, name.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw MeshError("cannot start " + name + ": " + std::strerror(error));
  return child;
}

/// @return status as of waitpid; −1: killed at the time limit.
int wait_for(pid_t child, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(10ms);
  }
  return status;
}

void judge(int status, const MesherLimits& limits, const std::string& said) {
  const std::string quoted = said.empty() ? std::string() : ": " + said;
  std::ostringstream text;
  if (status == -1) {
    text << "the mesher did not finish within " << limits.seconds << " s and was stopped" << quoted
         << "; try a larger element_size";
    throw MeshError(text.str());
  }
  if (WIFSIGNALED(status)) {
    text << "the mesher crashed (" << strsignal(WTERMSIG(status)) << ")" << quoted
         << "; the geometry may be degenerate";
    throw MeshError(text.str());
  }
  if (WEXITSTATUS(status) == 4) {
    text << "the mesher ran out of memory (limit " << limits.memory_mb << " MB)" << quoted
         << "; try a larger element_size";
    throw MeshError(text.str());
  }
  if (WEXITSTATUS(status) != 0) {
    throw MeshError(said.empty() ? "the mesher failed" : "the mesher failed: " + said);
  }
}

}  // namespace

void mesh_blade(const BladeGeometry& geometry, double element_size, const fs::path& file,
                const MesherLimits& limits) {
  check_geometry(geometry, element_size);
  if (!(limits.seconds > 0.0) || !(limits.memory_mb > 0.0)) {
    throw std::invalid_argument("mesher limits must be above 0 s and 0 MB");
  }
  const fs::path program = mesher_program();
  const std::string stem = file.string() + "." + std::to_string(::getpid());
  const ScratchFile input(stem + ".in");
  const ScratchFile messages(stem + ".out");
  const ScratchFile mesh(stem + ".msh");
  {
    std::ofstream stream(input.path());
    stream << parameters(geometry, element_size);
    if (!stream.flush()) throw MeshError("cannot write " + input.path().string());
  }
  const pid_t child = start(program, input.path(), mesh.path(), messages.path(), limits.memory_mb);
  const int status = wait_for(child, limits.seconds);  // before its messages are read
  judge(status, limits, tail_of(messages.path()));
  std::error_code error;
  fs::rename(mesh.path(), file, error);
  if (error) throw MeshError("the mesher left no mesh at " + file.string() + ": " + error.message());
}

}  // namespace microslip::mesh
