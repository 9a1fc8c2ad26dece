#include "pipelines/system/result_cache.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipelines/system/byte_archive.hpp"
#include "pipelines/system/interrupt.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"
#include "pipelines/system/sealed_bytes.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

ResultCache* used = nullptr;

/// The program is known by its bytes: builds of one version need not solve alike.
std::string header() {
  static const std::string line = fmt::format("microslip {} {:016x}", MICROSLIP_VERSION,
                                              fingerprint(bytes_of("/proc/self/exe")));
  return line;
}

std::string value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? std::string() : value;
}

/// Another process has it: false. Where files cannot be locked nobody waits,
/// and files are written whole all the same.
bool lock(int descriptor, std::uint64_t number) {
  struct flock range = {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  range.l_start = static_cast<off_t>(number >> 1U);  // a byte of the lock file for each result
  range.l_len = 1;
  return ::fcntl(descriptor, F_OFD_SETLK, &range) == 0 || (errno != EAGAIN && errno != EACCES);
}

struct File {
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t size = 0;
};

bool is_result(const fs::path& file) { return file.extension() == ".cached"; }

/// Of results, and of what a killed run was about to name so; those used last come last.
std::vector<File> files_in(const fs::path& folder) {
  std::vector<File> files;
  std::error_code gone;  // another run may remove what is looked at
  for (const auto& entry : fs::directory_iterator(folder, gone)) {
    if (!is_result(entry.path()) && entry.path().extension() != ".part") continue;
    const auto time = entry.last_write_time(gone);
    if (gone) continue;
    const auto size = entry.file_size(gone);
    if (!gone) files.push_back({entry.path(), time, size});
  }
  std::ranges::sort(files, {}, &File::used);
  return files;
}

}  // namespace

fs::path cache_folder() {
  if (const std::string given = value_of("MICROSLIP_CACHE"); !given.empty()) {
    return given == "off" ? fs::path() : fs::path(given);
  }
  if (const std::string given = value_of("XDG_CACHE_HOME"); given.starts_with('/')) {
    return fs::path(given) / "microslip";
  }
  const std::string home = value_of("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".cache" / "microslip";
}

ResultCache::ResultCache(fs::path folder, Tell tell, std::uintmax_t most_bytes)
    : folder_(std::move(folder)), tell_(std::move(tell)), most_bytes_(most_bytes) {
  if (folder_.empty()) return;
  try {
    make_folder(folder_);
    used = this;
  } catch (const ExhaustedError& error) {
    tell_(fmt::format("nothing is taken from earlier runs: {}", error.what()));
  }
}

ResultCache::~ResultCache() {
  if (used == this) used = nullptr;
}

ResultCache* ResultCache::in_use() { return used; }

ResultCache::Entry ResultCache::entry(std::string kind, std::string_view inputs) {
  return {*this, std::move(kind), inputs};
}

fs::path ResultCache::file_of(std::string_view kind, std::string_view inputs) const {
  const std::uint64_t number = fingerprint(inputs);
  const std::uint64_t again = fingerprint(inputs, ~number);  // 64 bits alone may meet by chance
  return folder_ / fmt::format("{}-{:016x}{:016x}.cached", kind, number, again);
}

std::optional<std::string> ResultCache::found_in(const fs::path& file,
                                                 std::string_view kind) const {
  const std::string content = bytes_of(file);
  if (content.empty()) return std::nullopt;
  const Unsealed kept = unsealed(header(), content);
  if (!kept.fault.empty()) {
    tell_(fmt::format("{}: {}: {}; it is made again", kind, file.string(), kept.fault));
    return std::nullopt;
  }
  std::error_code ignored;  // a folder that can only be read
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // what is used stays
  tell_(fmt::format("{}: taken from an earlier run, {}", kind, file.string()));
  return std::string(kept.bytes);
}

std::optional<std::string> ResultCache::kept(std::string_view kind, std::string_view inputs) const {
  return found_in(file_of(kind, inputs), kind);
}

void ResultCache::make_room(std::uintmax_t bytes) const {
  std::vector<File> files = files_in(folder_);
  for (const File& file : files) bytes += file.size;
  std::error_code ignored;  // gone already
  for (const File& file : files) {
    const bool is_leftover =
        !is_result(file.path) && fs::file_time_type::clock::now() - file.used > 1h;
    if (bytes <= most_bytes_ && !is_leftover) continue;
    if (!is_result(file.path) && !is_leftover) continue;  // being written
    fs::remove(file.path, ignored);
    bytes -= file.size;
  }
}

ResultCache::Entry::Entry(ResultCache& cache, std::string kind, std::string_view inputs)
    : cache_(cache), kind_(std::move(kind)) {
  file_ = cache.file_of(kind_, inputs);
  lock_ = ::open((cache.folder_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ >= 0) wait_for_turn(fingerprint(inputs));
}

ResultCache::Entry::~Entry() {
  if (lock_ >= 0) ::close(lock_);
}

void ResultCache::Entry::wait_for_turn(std::uint64_t number) {
  bool told = false;
  while (!lock(lock_, number)) {
    if (interrupt_requested()) {
      ::close(lock_);
      throw InterruptedError("interrupted");
    }
    if (!std::exchange(told, true)) {
      cache_.tell_(fmt::format("{}: another run makes the same: waiting for it", kind_));
    }
    std::this_thread::sleep_for(20ms);
  }
}

std::optional<std::string> ResultCache::Entry::find() const {
  return cache_.found_in(file_, kind_);
}

void ResultCache::Entry::keep(std::string_view bytes) const {
  if (bytes.size() > cache_.most_bytes_) return;
  try {
    cache_.make_room(bytes.size());
    write_whole(file_, sealed(header(), bytes));
  } catch (const ExhaustedError& error) {
    cache_.tell_(fmt::format("{}: not kept for later runs: {}", kind_, error.what()));
  }
}

}  // namespace microslip::pipelines
