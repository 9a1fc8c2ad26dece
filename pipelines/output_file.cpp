#include "pipelines/output_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>
#include <utility>

#include "pipelines/scene_error.hpp"

namespace microslip::pipelines {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int code) {
  throw ExhaustedError(
      fmt::format("{}: {}: {}; check free space and permissions, or choose another folder with -o",
                  path.string(), what, std::system_category().message(code)));
}

/// A file that removes itself unless it was renamed into place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : target_(target) {
    static std::atomic<unsigned> counter{0};
    path_ = target;
    path_.replace_filename(
        fmt::format(".{}.{}.{}.part", target.filename().string(), ::getpid(), counter++));
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(target_, "cannot be written", errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&&) = delete;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, "cannot be written", errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void move_into_place() {
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0) fail(target_, "cannot be completed", errno);
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail(target_, "cannot be replaced", errno);
    path_.clear();
  }

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace

void write_whole(const std::filesystem::path& file, std::string_view content) {
  TemporaryFile temporary(file);
  temporary.write(content);
  temporary.move_into_place();
}

void write_whole(const std::filesystem::path& file, std::span<const std::byte> content) {
  write_whole(file,
              std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) fail(folder, "folder cannot be created", code.value());
  if (!std::filesystem::is_directory(folder, code)) fail(folder, "is not a folder", ENOTDIR);
}

void require_writable(const std::filesystem::path& folder) {
  const TemporaryFile probe(folder / "probe");
}

std::string format_number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace microslip::pipelines
