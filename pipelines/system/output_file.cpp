#include "pipelines/system/output_file.hpp"

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

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int code) {
  throw ExhaustedError(
      fmt::format("{}: {}: {}; check free space and permissions, or choose another folder with -o",
                  path.string(), what, std::system_category().message(code)));
}

void write_to(int descriptor, std::string_view content, const std::filesystem::path& target) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(target, "cannot be written", errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
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

  void write(std::string_view content) { write_to(descriptor_, content, target_); }

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

/// A device or pipe takes what comes and cannot be replaced.
void write_through(const std::filesystem::path& file, std::string_view content) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, "cannot be written", errno);
  try {
    write_to(descriptor, content, file);
  } catch (const ExhaustedError&) {
    ::close(descriptor);
    throw;
  }
  if (::close(descriptor) != 0) fail(file, "cannot be completed", errno);
}

/// The part of a path that is there and is no folder: the path itself, or one on the way to it.
/// Empty: none.
std::filesystem::path file_on_the_way(const std::filesystem::path& path) {
  std::error_code code;
  for (std::filesystem::path part = std::filesystem::absolute(path, code); part.has_relative_path();
       part = part.parent_path()) {
    if (!std::filesystem::exists(part, code)) continue;
    return std::filesystem::is_directory(part, code) ? std::filesystem::path() : part;
  }
  return {};
}

}  // namespace

void require_folder_name(const std::filesystem::path& folder, const std::string& option) {
  const std::filesystem::path file = file_on_the_way(folder);
  if (file.empty()) return;
  throw SceneError(
      fmt::format("{} {}: {} is a file; expected the name of a folder, new or there already",
                  option, folder.string(), file.string()));
}

void require_file_name(const std::filesystem::path& file, const std::string& option) {
  std::error_code code;
  if (std::filesystem::is_directory(file, code)) {
    throw SceneError(
        fmt::format("{} {}: is a folder; expected the name of a file", option, file.string()));
  }
  const std::filesystem::path folder = std::filesystem::absolute(file, code).parent_path();
  require_folder_name(folder, option);
  if (!std::filesystem::exists(folder, code) && !code) {
    throw SceneError(
        fmt::format("{} {}: the folder to write in does not exist", option, file.string()));
  }
}

void write_whole(const std::filesystem::path& file, std::string_view content) {
  std::error_code code;  // what cannot be looked at is told where it is opened
  if (std::filesystem::exists(file, code) && !std::filesystem::is_regular_file(file, code) &&
      !std::filesystem::is_directory(file, code)) {
    write_through(file, content);
    return;
  }
  const bool is_link = std::filesystem::is_symlink(file, code);
  TemporaryFile temporary(is_link ? std::filesystem::weakly_canonical(file, code) : file);
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

FolderToFill::FolderToFill(const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::path missing = std::filesystem::absolute(folder, code).lexically_normal();
  while (!missing.empty() && !std::filesystem::exists(missing, code) && !code) {
    made_.push_back(missing);
    missing = missing.parent_path();
  }
  make_folder(folder);
  require_writable(folder);
}

FolderToFill::~FolderToFill() {
  std::error_code code;  // one that is not empty stays
  for (const std::filesystem::path& folder : made_) std::filesystem::remove(folder, code);
}

std::string format_number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace microslip::pipelines
