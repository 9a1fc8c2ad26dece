#include "pipelines/record/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

namespace fs = std::filesystem;

/// A line per file: a mark, and its path in the folder.
constexpr const char* list_name = "checkpoint/files.txt";
constexpr char own_mark = '+';      // of the last run
constexpr char earlier_mark = '-';  // of runs before it

/// Names of results. A folder that holds one and no run is not ours.
constexpr std::array result_names{"curves",
                                  "maps",
                                  "motion",
                                  "plots",
                                  "modes.csv",
                                  "modes.vtu",
                                  "model.h5",
                                  "report.md",
                                  "report.html",
                                  "scene.toml",
                                  "summary.json",
                                  "log.txt",
                                  "history.csv",
                                  "peak_against_preload.csv",
                                  "peak_against_parameter.csv"};

int lock_folder(const fs::path& folder) {
  const fs::path file = folder / ".lock";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    throw ExhaustedError(fmt::format("{}: cannot be written: {}; remove it, or choose another -o",
                                     file.string(), std::system_category().message(errno)));
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    throw ExhaustedError("another run is writing in " + folder.string() + "; choose another -o");
  }
  return descriptor;
}

void require_own(const fs::path& folder) {
  const auto holds = [&](const char* name) { return fs::exists(folder / name); };
  // Runs of earlier programs have no list.
  const bool is_earlier = holds("scene.toml") && holds("log.txt") && holds("summary.json");
  if (RunFolder::has_list(folder) || is_earlier) return;
  for (const char* name : result_names) {
    if (!holds(name)) continue;
    throw SceneError(
        fmt::format("-o {}: holds \"{}\", which no run has written and a run would replace; "
                    "choose another folder",
                    folder.string(), name));
  }
}

bool is_part(const fs::path& file) {
  return file.filename().string().starts_with(".") && file.extension() == ".part";
}

/// Files that a killed run was about to rename: output_file.cpp names them so.
void remove_parts(const fs::path& folder) {
  std::error_code ignored;  // what cannot be removed harms nobody
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (is_part(entry.path())) fs::remove(entry.path(), ignored);
  }
}

/// Of all files below a folder, relative to it, in order; none where there is no folder.
std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder, none)) {
    if (!entry.is_regular_file() || is_part(entry.path())) continue;
    files.push_back(entry.path().lexically_relative(folder).string());
  }
  std::ranges::sort(files);
  return files;
}

/// curves, maps, modes.csv, …: what a stage replaces as a whole.
std::string first_part(const std::string& file) { return file.substr(0, file.find('/')); }

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::rename(from, to, code);
  if (code) {
    throw ExhaustedError(fmt::format("{}: cannot be put in its place: {}; choose another -o",
                                     to.string(), code.message()));
  }
}

}  // namespace

RunFolder::RunFolder(fs::path folder, RunStart start) : folder_(std::move(folder)) {
  make_folder(folder_);
  require_writable(folder_);
  require_own(folder_);
  lock_ = lock_folder(folder_);
  try {
    read_list(start);
    std::error_code ignored;  // what cannot be removed cannot be written either: said there
    fs::remove_all(staged(), ignored);
    remove_parts(folder_);
    remove_parts(folder_ / "checkpoint");
    make_folder(staged());
    if (!fs::exists(folder_ / "summary.json")) has_list_ = true;  // nothing stands here
    if (has_list_) write_list();                                  // a folder of our own from now on
  } catch (...) {
    unlock();
    throw;
  }
}

RunFolder::~RunFolder() {
  remove_staged();
  unlock();
}

void RunFolder::remove_staged() {
  std::error_code ignored;  // a leftover that the next run removes
  fs::remove_all(staged(), ignored);
}

bool RunFolder::has_list(const fs::path& folder) { return fs::exists(folder / list_name); }

bool RunFolder::is_held(const fs::path& folder) {
  const int descriptor = ::open((folder / ".lock").c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  ::close(descriptor);
  return !is_free;
}

void RunFolder::unlock() {
  if (lock_ < 0) return;
  ::unlink((folder_ / ".lock").c_str());
  ::close(std::exchange(lock_, -1));
}

bool RunFolder::would_replace() const {
  std::set<std::string> places;
  for (const std::string& file : earlier_) places.insert(first_part(file));
  return std::ranges::any_of(files_below(staged()), [&](const std::string& file) {
    return places.contains(first_part(file)) ||
           (!own_.contains(file) && fs::exists(folder_ / file));
  });
}

std::string RunFolder::in_place(std::string message) const {
  const std::string folder = staged().string();
  for (std::size_t at = message.find(folder); at != std::string::npos; at = message.find(folder)) {
    message.replace(at, folder.size(), folder_.string());
  }
  return message;
}

void RunFolder::publish() {
  const std::vector<std::string> files = files_below(staged());
  if (files.empty()) return;
  std::ofstream list(folder_ / list_name, std::ios::app);
  for (const std::string& file : files) list << own_mark << file << '\n';
  list.close();  // first: a file that is in its place is known to be ours
  if (!list) throw ExhaustedError((folder_ / list_name).string() + ": cannot be written");
  for (const std::string& file : files) {
    const fs::path place = folder_ / file;
    make_folder(place.parent_path());
    const bool is_foreign = has_list_ && !own_.contains(file) && !earlier_.contains(file);
    if (is_foreign && fs::exists(place)) move_file(place, place.string() + ".kept");
    move_file(staged() / file, place);
    own_.insert(file);
    earlier_.erase(file);
  }
}

template <typename Which>
void RunFolder::remove_earlier_if(const Which& which) {
  std::error_code ignored;  // already gone, or no longer ours to remove
  std::erase_if(earlier_, [&](const std::string& file) {
    if (!which(file)) return false;
    fs::remove(folder_ / file, ignored);
    const fs::path parent = (folder_ / file).parent_path();
    if (parent != folder_) fs::remove(parent, ignored);  // only if that was its last file
    return true;
  });
  write_list();
}

void RunFolder::remove_superseded() {
  std::set<std::string> replaced;
  for (const std::string& file : own_) replaced.insert(first_part(file));
  remove_earlier_if([&](const std::string& file) { return replaced.contains(first_part(file)); });
}

void RunFolder::remove_earlier() {
  remove_earlier_if([](const std::string&) { return true; });
}

void RunFolder::read_list(RunStart start) {
  has_list_ = has_list(folder_);
  std::ifstream list(folder_ / list_name);
  for (std::string line; std::getline(list, line);) {
    if (line.empty()) continue;
    const bool is_own = line.front() == own_mark && start == RunStart::resumed;
    (is_own ? own_ : earlier_).insert(line.substr(1));
  }
  for (const std::string& file : own_) earlier_.erase(file);
}

void RunFolder::write_list() const {
  std::string text;
  for (const std::string& file : own_) text += own_mark + file + "\n";
  for (const std::string& file : earlier_) text += earlier_mark + file + "\n";
  write_whole(folder_ / list_name, text);
}

}  // namespace microslip::pipelines
