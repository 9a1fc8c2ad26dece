#include "pipelines/system/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include <fmt/core.h>

#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Clock = std::chrono::steady_clock;

/// Both ends of a pipe, closed when done with.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::system_category(), "pipe");
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  Pipe(Pipe&&) = delete;
  Pipe& operator=(Pipe&&) = delete;
  ~Pipe() {
    close_writer();
    ::close(ends_[0]);
  }
  void close_writer() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  [[nodiscard]] int reader() const { return ends_[0]; }
  [[nodiscard]] int writer() const { return ends_[1]; }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// @return 0, or the reason it could not be started.
int start(const std::vector<std::string>& command, int output, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  // A group of its own: it ends with the processes it has started itself.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int code =
      ::posix_spawnp(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return code;
}

enum class Reading { ended, late, interrupted };

/// Reads until the other end is closed, the limit has passed or an interrupt is asked for.
Reading read_until(int reader, Clock::time_point deadline, std::string& text) {
  constexpr int longest_wait = 50;  // ms: an interrupt ends the child well within a second
  std::array<char, 4096> buffer{};
  while (true) {
    if (interrupt_requested()) return Reading::interrupted;
    if (Clock::now() >= deadline) return Reading::late;
    pollfd waiting{reader, POLLIN, 0};
    if (::poll(&waiting, 1, longest_wait) <= 0) continue;
    const ssize_t size = ::read(reader, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return Reading::ended;
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);  // npos + 1 is 0: the only line
}

}  // namespace

ChildResult run_child(const std::vector<std::string>& command, std::chrono::milliseconds limit) {
  const Clock::time_point deadline = Clock::now() + limit;
  Pipe pipe;
  pid_t child = 0;
  if (const int code = start(command, pipe.writer(), child); code != 0) {
    return {false, fmt::format("{} cannot be started: {}", command.front(),
                               std::system_category().message(code))};
  }
  pipe.close_writer();
  std::string output;
  if (const Reading outcome = read_until(pipe.reader(), deadline, output);
      outcome != Reading::ended) {
    ::kill(-child, SIGKILL);
    wait_for(child);
    if (outcome == Reading::interrupted) {
      throw InterruptedError("interrupted while " + command.front() + " was running");
    }
    return {false, fmt::format("{} took longer than {} s", command.front(),
                               static_cast<double>(limit.count()) / 1e3)};
  }
  const int status = wait_for(child);
  if (WIFSIGNALED(status)) {
    return {false, fmt::format("{} was ended by signal {}", command.front(), WTERMSIG(status))};
  }
  if (WEXITSTATUS(status) != 0) return {false, last_line(output), WEXITSTATUS(status)};
  return {true};
}

}  // namespace microslip::pipelines
