#include "mesh/mesher_process.hpp"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "mesh/import/mesher_job.hpp"
#include "mesh/mesh_error.hpp"

extern char** environ;  // NOLINT: POSIX names it so

namespace microslip::mesh {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

std::string blade_job(const BladeGeometry& g, const ElementSizes& sizes) {
  std::ostringstream text = job_text();
  text << "blade\nelement_size " << sizes.element_size << "\nedge_size "
       << sizes.edge_size.value_or(sizes.element_size) << "\nroot_width " << g.root_width
       << "\nroot_height " << g.root_height << "\nroot_length " << g.root_length
       << "\nplatform_width " << g.platform_width << "\nplatform_height " << g.platform_height
       << "\nplatform_length " << g.platform_length << "\nspan " << g.span << "\nroot_chord "
       << g.root_chord << "\ntip_chord " << g.tip_chord << "\nroot_thickness " << g.root_thickness
       << "\ntip_thickness " << g.tip_thickness << "\nroot_stagger " << g.root_stagger
       << "\ntip_stagger " << g.tip_stagger << "\ncamber " << g.camber << "\nlean " << g.lean
       << '\n';
  return text.str();
}

/// Removes its file when it goes, if it is still there: a mesher that is killed leaves one.
class ScratchFile {
 public:
  explicit ScratchFile(fs::path path) : path_(std::move(path)) {}
  ~ScratchFile() {
    std::error_code ignored;  // gone already, or in its place
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

/// A file without a name: whatever ends this process leaves nothing of it behind.
class AnonymousFile {
 public:
  explicit AnonymousFile(const std::string& content = {})
      : descriptor_(::memfd_create("microslip", MFD_CLOEXEC)) {
    const auto size = static_cast<ssize_t>(content.size());
    if (descriptor_ < 0 || ::write(descriptor_, content.data(), content.size()) != size) {
      throw MeshError(std::string("cannot start the mesher: ") + std::strerror(errno));
    }
    ::lseek(descriptor_, 0, SEEK_SET);  // whoever inherits it reads from here
  }
  ~AnonymousFile() { ::close(descriptor_); }
  AnonymousFile(const AnonymousFile&) = delete;
  AnonymousFile& operator=(const AnonymousFile&) = delete;
  AnonymousFile(AnonymousFile&&) = delete;
  AnonymousFile& operator=(AnonymousFile&&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// The last lines it holds.
  [[nodiscard]] std::string tail() const {
    constexpr off_t most = 600;
    const off_t size = ::lseek(descriptor_, 0, SEEK_END);
    const off_t from = std::max<off_t>(size - most, 0);
    std::string text(static_cast<std::size_t>(size - from), '\0');
    const ssize_t n = ::pread(descriptor_, text.data(), text.size(), from);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    text = std::regex_replace(text, std::regex("\x1b\\[[0-9;]*m"), "");  // OpenCASCADE's colours
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    return from > 0 ? "…" + text : text;
  }

 private:
  int descriptor_;
};

/// In a process group of its own: Ctrl-C is for this process to answer.
pid_t start(const fs::path& program, int input, const fs::path& scratch, const fs::path& output,
            int messages, double memory_mb) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  std::string name = program.string();
  std::string unfinished = scratch.string();
  std::string file = output.string();
  std::string memory = std::to_string(memory_mb);
  std::string parent = std::to_string(::getpid());
  std::array<char*, 6> arguments{name.data(),   unfinished.data(), file.data(),
                                 memory.data(), parent.data(),     nullptr};
  pid_t child = 0;
  const int error =
      posix_spawn(&child, name.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw MeshError("cannot start " + name + ": " + std::strerror(error));
  return child;
}

constexpr int out_of_time = -1;
constexpr int stopped = -2;

/// @return status as of waitpid; out_of_time or stopped: killed.
int wait_for(pid_t child, const MesherLimits& limits) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limits.seconds);
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    const bool late = std::chrono::steady_clock::now() > end;
    if (late || (limits.stop && limits.stop())) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return late ? out_of_time : stopped;
    }
    std::this_thread::sleep_for(10ms);
  }
  return status;
}

void judge(int status, const MesherLimits& limits, const fs::path& output,
           const std::string& said) {
  const std::string quoted = said.empty() ? std::string() : ": " + said;
  std::ostringstream text;
  if (status == stopped) throw MeshError("the mesher was stopped");
  if (status == out_of_time) {
    text << "the mesher did not finish within " << limits.seconds << " s and was stopped" << quoted
         << "; try a larger element_size";
    throw MeshError(text.str());
  }
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGKILL || WTERMSIG(status) == SIGTERM)) {
    text << "the mesher was ended from outside (" << strsignal(WTERMSIG(status))
         << "), by somebody or for want of memory" << quoted;
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
    throw MeshRoomError(text.str());
  }
  if (WEXITSTATUS(status) == 5) {
    text << output.string() << ": cannot be written" << quoted
         << "; check free space and limits of file size (ulimit -f)";
    throw MeshRoomError(text.str());
  }
  if (WEXITSTATUS(status) != 0) {
    throw MeshError(said.empty() ? "the mesher failed" : "the mesher failed: " + said);
  }
}

}  // namespace

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

std::ostringstream job_text() {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  return text;
}

void run_mesher(const std::string& job, const fs::path& file, const MesherLimits& limits) {
  if (!(limits.seconds > 0.0) || !(limits.memory_mb > 0.0)) {
    throw std::invalid_argument("mesher limits must be above 0 s and 0 MB");
  }
  const fs::path program = mesher_program();
  const AnonymousFile input(job);
  const AnonymousFile messages;
  const ScratchFile scratch(file.string() + "." + std::to_string(::getpid()) +
                            file.extension().string());
  const pid_t child = start(program, input.descriptor(), scratch.path(), file,
                            messages.descriptor(), limits.memory_mb);
  const int status = wait_for(child, limits);  // before its messages are read
  judge(status, limits, file, messages.tail());
  if (!fs::exists(file)) throw MeshError("the mesher left nothing at " + file.string());
}

void mesh_blade(const BladeGeometry& geometry, const ElementSizes& sizes, const fs::path& file,
                const MesherLimits& limits) {
  check_geometry(geometry, sizes);
  run_mesher(blade_job(geometry, sizes), file, limits);
}

}  // namespace microslip::mesh
