/// @file
/// A run folder as a place. The files of a stage are written beside those of an earlier run, in
/// checkpoint/staged, and put in their places when the stage has ended; checkpoint/files.txt lists
/// what runs have written here, so that nothing else is ever replaced or removed.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace microslip::pipelines {

enum class RunStart {
  anew,    ///< what is listed belongs to earlier runs
  resumed  ///< the run that was killed or interrupted here goes on
};

class RunFolder {
 public:
  /// Makes the folder and locks it against a second run (the lock dies with the process); leftovers
  /// of a run that was killed are removed.
  /// @throws SceneError      it holds a file with the name of a result, and no run:
  ///         not ours to replace.
  /// @throws ExhaustedError  another run holds it, or nothing can be written there.
  RunFolder(std::filesystem::path folder, RunStart start);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  RunFolder(RunFolder&&) = delete;
  RunFolder& operator=(RunFolder&&) = delete;

  /// Whether a folder tells what runs have written in it: those of older versions do not.
  [[nodiscard]] static bool has_list(const std::filesystem::path& folder);
  /// Whether a run is writing there.
  [[nodiscard]] static bool is_held(const std::filesystem::path& folder);
  [[nodiscard]] std::filesystem::path staged() const { return folder_ / "checkpoint" / "staged"; }
  /// What is told of staged files, of the places that they are for: where they are staged they are
  /// gone when the message is read.
  [[nodiscard]] std::string in_place(std::string message) const;
  /// Something that this run has not written stands in the place of what is staged.
  [[nodiscard]] bool would_replace() const;

  /// Puts what is staged in its place. A file there that no run has written is renamed to
  /// NAME.kept; in a folder of a version that kept no list it is taken for that run's.
  /// @throws ExhaustedError  a file cannot be moved.
  void publish();
  /// Removes files of earlier runs that stand beside new ones, in curves/, maps/, …,
  /// and have no successor.
  void remove_superseded();
  /// Removes all files of earlier runs that have no successor.
  void remove_earlier();
  /// For a process that ends without unwinding: what is staged and not published, and the lock.
  void remove_staged();
  void unlock();

 private:
  template <typename Which>
  void remove_earlier_if(const Which& which);
  void read_list(RunStart start);
  void write_list() const;

  std::filesystem::path folder_;
  int lock_ = -1;
  bool has_list_ = false;          ///< of the runs before
  std::set<std::string> earlier_;  ///< files of runs before, without successor so far
  std::set<std::string> own_;      ///< files of this run in their places
};

}  // namespace microslip::pipelines
