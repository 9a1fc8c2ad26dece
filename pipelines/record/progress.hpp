/// @file
/// What a user sees while a run goes on, and what stays of it: one live line on a terminal, plain
/// lines otherwise; log.txt; history.csv with one line per finished point;
/// seconds and memory per stage.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "pipelines/record/run_folder.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/system/machine.hpp"

namespace spdlog {
class logger;
}

namespace microslip::pipelines {

enum class Verbosity { quiet, normal, verbose };

/// Every member may be called from several threads.
class Progress {
 public:
  /// @param out       where lines go: standard error in the program.
  /// @param terminal  `out` is a terminal: the live line is drawn there.
  /// @param verbosity quiet: warnings only. verbose: a plain line per point as well.
  Progress(std::ostream& out, bool terminal, Verbosity verbosity);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;
  ~Progress();

  /// Starts log.txt and history.csv in a run folder, or goes on with them; what was said before is
  /// in the log as well.
  /// @throws ExhaustedError  a file cannot be created.
  void keep_in(const std::filesystem::path& folder, RunStart start = RunStart::anew);

  /// Ends the stage before and begins this one.
  void stage(const std::string& name);
  /// What this stage, or what of it begins now, is expected to take [s]; 0: not known. While it
  /// says nothing else, a stage tells how long it has taken and what is left: every second on a
  /// terminal, elsewhere after two and then every ten.
  void expect(double seconds);
  /// What of this stage is being done, for those lines, as long as the object lives; of several the
  /// one begun last.
  class Part {
   public:
    Part(Progress& progress, int number) : progress_(progress), number_(number) {}
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    Part(Part&&) = delete;
    Part& operator=(Part&&) = delete;
    ~Part() { progress_.end_part(number_); }

   private:
    Progress& progress_;
    int number_;
  };
  [[nodiscard]] Part part(const std::string& what);
  /// A point of a curve is finished.
  /// @param fraction  done, 0 … 1, of what was begun with the stage or the last expectation, for
  ///                  the time left; below 0: not known.
  void point(const std::string& curve, const solver::ResponsePoint& point, double fraction);
  /// A curve is finished: lines of history.csv that it does not hold (of a sweep that was given up
  /// for one from the other end, or cut short and made again) are taken out, the file written anew.
  /// @throws ExhaustedError  it cannot be.
  void settle(const std::string& curve, const std::vector<solver::ResponsePoint>& points);
  void info(const std::string& sentence);
  /// To the log alone.
  void note(const std::string& sentence);
  void warning(const std::string& sentence);
  /// The error that ends a run: to the log; the program prints it itself.
  void error(const std::string& sentence);
  /// Ends the last stage and clears the live line. Called by the destructor as well.
  void finish();

  /// Seconds and memory of the stages so far, the running one included.
  [[nodiscard]] std::vector<StageRecord> stages() const;
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  using Clock = std::chrono::steady_clock;
  enum class Level { info, warning, error };

  void say(Level level, const std::string& sentence);
  void log(Level level, const std::string& sentence);
  void print_line(const std::string& line);
  void draw_live(const std::string& line);
  void clear_live();
  void end_stage();
  void end_part(int number);
  void start_clock();
  void tell_time(const std::stop_token& stop);
  /// Since the last line of the stage, or its begin.
  [[nodiscard]] Clock::duration silence(Clock::time_point now) const;
  /// After which a line is due that is not drawn on a terminal.
  [[nodiscard]] std::chrono::seconds plain_interval() const;
  [[nodiscard]] std::string time_text(Clock::time_point now) const;
  [[nodiscard]] double seconds_left(Clock::time_point now) const;  ///< below 0: more than expected
  void open_history(RunStart start);
  void append_history(const std::string& curve, const solver::ResponsePoint& point);
  [[nodiscard]] StageRecord running_stage() const;

  mutable std::mutex mutex_;  ///< of all below; those who only read lock it too
  std::ostream& out_;
  bool terminal_;
  Verbosity verbosity_;
  bool live_ = false;  ///< a live line stands on the terminal
  Clock::time_point begin_ = Clock::now();
  Clock::time_point stage_begin_ = begin_;
  Clock::time_point last_drawn_{};
  std::string stage_;
  std::map<int, std::string> parts_;       ///< of it, that are being done, in words
  int n_parts_ = 0;                        ///< begun so far
  Clock::time_point part_begin_ = begin_;  ///< of what is expected, of which fractions are told
  double expected_ = 0.0;                  ///< to take [s]; 0: not known
  bool has_points_ = false;                ///< which tell more
  double fraction_ = 0.0;                  ///< done at the last of them
  std::optional<MemoryGauge> gauge_;
  std::vector<StageRecord> stages_;
  std::vector<std::string> warnings_;
  std::vector<std::pair<Level, std::string>> unlogged_;  ///< said before there was a log
  std::shared_ptr<spdlog::logger> log_;                  // shared: the library's own handle type
  std::ofstream history_;
  std::filesystem::path history_file_;
  std::map<std::string, std::size_t> history_lines_;  ///< of each curve
  std::condition_variable_any stopped_;
  std::jthread clock_;  // last: it reads the others
};

}  // namespace microslip::pipelines
