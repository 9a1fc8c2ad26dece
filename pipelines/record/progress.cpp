#include "pipelines/record/progress.hpp"

#include <fmt/core.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <exception>
#include <iostream>
#include <numbers>
#include <ostream>
#include <set>
#include <system_error>

#include "pipelines/files/columns.hpp"
#include "pipelines/system/output_file.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

using Seconds = std::chrono::duration<double>;

double hertz(double angular) { return angular / (2.0 * std::numbers::pi); }

/// Columns of the terminal behind standard error.
std::size_t terminal_width() {
  winsize size{};
  constexpr std::size_t usual = 80;
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return usual;
  return size.ws_col;
}

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02d} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02d} min", whole / 3600, whole / 60 % 60);
}

/// What a line of history.csv begins with: curve, frequency, amplitude.
std::string line_begin(const std::string& curve, const solver::ResponsePoint& point) {
  return row_of(history_columns().first(3), {curve, point});
}

std::string place_of(const std::string& curve, const solver::ResponsePoint& point) {
  return fmt::format("{}  {:.4g} Hz  {:.3g} m", curve, hertz(point.frequency), point.amplitude);
}

std::string describe(const std::string& curve, const solver::ResponsePoint& point) {
  constexpr double percent = 100.0;
  std::string text = place_of(curve, point);
  const contact::CycleReport& share = point.report;
  if (share.stick_share + share.slip_share + share.separated_share > 0.0) {
    text += fmt::format("  stick {:.0f} % slip {:.0f} % open {:.0f} %", percent * share.stick_share,
                        percent * share.slip_share, percent * share.separated_share);
  }
  return text;
}

constexpr double first_guess = 0.01;  // before this much of a stage is done a forecast is noise

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, Verbosity verbosity)
    : out_(out), terminal_(terminal), verbosity_(verbosity) {}

Progress::~Progress() {
  try {
    finish();
  } catch (const std::exception& error) {  // while another one ends the run: no memory for words
    std::cerr << error.what() << '\n';
  }
}

void Progress::keep_in(const std::filesystem::path& folder, RunStart start) {
  const std::lock_guard lock(mutex_);
  const std::filesystem::path file = folder / "log.txt";
  try {
    auto sink =
        std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), start == RunStart::anew);
    log_ = std::make_shared<spdlog::logger>("microslip", std::move(sink));
  } catch (const spdlog::spdlog_ex& error) {
    throw ExhaustedError(file.string() + ": cannot be written: " + error.what());
  }
  log_->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  log_->flush_on(spdlog::level::trace);  // a log that is complete when the process is killed
  for (const auto& [level, sentence] : unlogged_) log(level, sentence);
  unlogged_.clear();
  history_file_ = folder / "history.csv";
  open_history(start);
}

void Progress::open_history(RunStart start) {
  std::string text;
  std::ifstream before(history_file_);
  for (std::string line; start == RunStart::resumed && std::getline(before, line);) {
    if (before.eof()) break;  // a line that a kill has cut
    text.append(line).append("\n");
    ++history_lines_[line.substr(0, line.find(','))];
  }
  if (text.empty()) text = header_of(history_columns()) + '\n';
  write_whole(history_file_, text);
  history_.open(history_file_, std::ios::app);
}

void Progress::stage(const std::string& name) {
  const std::lock_guard lock(mutex_);
  end_stage();
  stage_ = name;
  parts_.clear();
  stage_begin_ = part_begin_ = Clock::now();
  expected_ = 0.0;
  has_points_ = false;
  fraction_ = 0.0;
  gauge_.emplace();
  log(Level::info, "stage " + name);
  if (terminal_) draw_live(name + " ...");
  start_clock();
}

void Progress::expect(double seconds) {
  const std::lock_guard lock(mutex_);
  part_begin_ = Clock::now();
  expected_ = seconds;
  has_points_ = false;
  fraction_ = 0.0;
}

Progress::Part Progress::part(const std::string& what) {
  const std::lock_guard lock(mutex_);
  parts_.emplace(++n_parts_, what);
  return {*this, n_parts_};
}

void Progress::end_part(int number) {
  const std::lock_guard lock(mutex_);
  parts_.erase(number);
}

void Progress::start_clock() {
  if (verbosity_ == Verbosity::quiet || clock_.joinable()) return;
  try {
    clock_ = std::jthread([this](const std::stop_token& stop) { tell_time(stop); });
  } catch (const std::system_error&) {  // no memory for a thread: the run goes on without
  }
}

Progress::Clock::duration Progress::silence(Clock::time_point now) const {
  return now - std::max(last_drawn_, stage_begin_);
}

std::chrono::seconds Progress::plain_interval() const {
  constexpr std::chrono::seconds first{2};
  constexpr std::chrono::seconds later{10};  // enough to see that it lives
  return last_drawn_ < stage_begin_ ? first : later;
}

double Progress::seconds_left(Clock::time_point now) const {
  const double elapsed = Seconds(now - part_begin_).count();
  const bool is_told = fraction_ > first_guess && fraction_ < 1.0;
  if (!is_told) return expected_ - elapsed;
  const double at_this_pace = elapsed * (1.0 - fraction_) / fraction_;
  if (!(expected_ > 0.0 && elapsed > 0.0)) return at_this_pace;
  // Fractions count frequency, and points crowd about resonances: the pace is believed as far as
  // it has come, the forecast beyond.
  const double as_expected = expected_ * (1.0 - fraction_);
  return as_expected * std::pow(at_this_pace / as_expected, fraction_);
}

std::string Progress::time_text(Clock::time_point now) const {
  std::string text =
      fmt::format("{}  {}", stage_, duration_text(Seconds(now - stage_begin_).count()));
  if (!parts_.empty()) text += ": " + parts_.rbegin()->second;
  const double left = seconds_left(now);
  if (left > 0.0) return text + ", some " + duration_text(left) + " left";
  if (expected_ == 0.0) return text;
  const double before = Seconds(part_begin_ - stage_begin_).count();
  text += ", where " + duration_text(before + expected_) + " were expected: ";
  constexpr double forecasts_hold = 2.0;  // to this factor (tests/verification/forecasts.py)
  const double at_most = left + (forecasts_hold - 1.0) * expected_;
  if (at_most <= 0.0) return text + "how much is left is not known";
  return text + duration_text(at_most) + " more at most if that is right to a factor of two";
}

void Progress::tell_time(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds tick{500};
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    stopped_.wait_for(lock, stop, tick, [] { return false; });
    const Clock::time_point now = Clock::now();
    const std::chrono::seconds on_terminal{has_points_ ? 3 : 1};
    if (stage_.empty() || silence(now) < (terminal_ ? on_terminal : plain_interval())) continue;
    last_drawn_ = now;
    const std::string line = time_text(now);
    if (terminal_) {
      draw_live(line);
    } else {
      print_line(line);
    }
  }
}

void Progress::point(const std::string& curve, const solver::ResponsePoint& point,
                     double fraction) {
  const std::lock_guard lock(mutex_);
  append_history(curve, point);
  has_points_ = true;
  fraction_ = fraction;
  const std::string text = describe(curve, point);
  if (verbosity_ == Verbosity::verbose) return print_line("  " + text);
  constexpr std::chrono::milliseconds redraw_interval{100};  // for the eye
  const Clock::time_point now = Clock::now();
  const bool is_due =
      terminal_ ? now - last_drawn_ >= redraw_interval : silence(now) >= plain_interval();
  if (!is_due) return;
  last_drawn_ = now;
  std::string left;
  if (fraction > first_guess || seconds_left(now) > 0.0) {
    left = "  " + duration_text(fraction < 1.0 ? seconds_left(now) : 0.0) + " left";
  }
  std::string line = fmt::format("{}  {}{}", stage_, text, left);
  if (terminal_) {
    // What does not fit is cut off at the end, where the time left stands.
    if (line.size() >= terminal_width()) {
      line = fmt::format("{}  {}{}", stage_, place_of(curve, point), left);
    }
    draw_live(line);
  } else {
    print_line(line);
  }
}

void Progress::settle(const std::string& curve, const std::vector<solver::ResponsePoint>& points) {
  const std::lock_guard lock(mutex_);
  if (!history_.is_open() || history_lines_[curve] <= points.size()) return;
  std::multiset<std::string> held;
  for (const solver::ResponsePoint& point : points) held.insert(line_begin(curve, point));
  history_.close();
  std::ifstream all(history_file_);
  if (!all) throw ExhaustedError(history_file_.string() + ": cannot be read any more");
  std::string kept;
  for (std::string line; std::getline(all, line);) {
    const std::size_t end = line.find(',', line.find(',', curve.size() + 1) + 1);
    if (line.starts_with(curve + ',')) {
      const auto found = held.find(line.substr(0, end));
      if (found == held.end()) continue;
      held.erase(found);  // once
    }
    kept.append(line).append("\n");
  }
  history_lines_[curve] = points.size();
  write_whole(history_file_, kept);
  history_.open(history_file_, std::ios::app);
}

void Progress::info(const std::string& sentence) { say(Level::info, sentence); }

void Progress::note(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  log(Level::info, sentence);
}

void Progress::warning(const std::string& sentence) {
  {
    const std::lock_guard lock(mutex_);
    warnings_.push_back(sentence);
  }
  say(Level::warning, sentence);
}

void Progress::error(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  log(Level::error, sentence);
}

void Progress::finish() {
  const std::lock_guard lock(mutex_);
  end_stage();
  clear_live();
  out_.flush();
}

std::vector<StageRecord> Progress::stages() const {
  const std::lock_guard lock(mutex_);
  std::vector<StageRecord> all = stages_;
  if (!stage_.empty()) all.push_back(running_stage());
  return all;
}

std::vector<std::string> Progress::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

void Progress::say(Level level, const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  log(level, sentence);
  if (level == Level::warning) {
    clear_live();
    out_ << "warning: " << sentence << '\n' << std::flush;
  } else {
    print_line("  " + sentence);
  }
}

void Progress::log(Level level, const std::string& sentence) {
  if (!log_) {
    unlogged_.emplace_back(level, sentence);
  } else if (level == Level::info) {
    log_->info("{}", sentence);
  } else if (level == Level::warning) {
    log_->warn("{}", sentence);
  } else {
    log_->error("{}", sentence);
  }
}

void Progress::print_line(const std::string& line) {
  if (verbosity_ == Verbosity::quiet) return;
  clear_live();
  out_ << line << '\n' << std::flush;
}

void Progress::draw_live(const std::string& line) {
  if (verbosity_ == Verbosity::quiet) return;
  const std::size_t width = terminal_width() - 1;
  out_ << "\r\033[K" << line.substr(0, width) << std::flush;
  live_ = true;
}

void Progress::clear_live() {
  if (live_) out_ << "\r\033[K" << std::flush;
  live_ = false;
}

StageRecord Progress::running_stage() const {
  return {stage_, Seconds(Clock::now() - stage_begin_).count(), gauge_ ? gauge_->peak_mb() : 0.0};
}

void Progress::end_stage() {
  if (stage_.empty()) return;
  const StageRecord record = running_stage();
  stages_.push_back(record);
  stage_.clear();
  log(Level::info, fmt::format("stage {} took {:.3f} s, at most {:.0f} MB", record.name,
                               record.seconds, record.peak_memory_mb));
  print_line(fmt::format("{:<12} {:8.2f} s  {:6.0f} MB", record.name, record.seconds,
                         record.peak_memory_mb));
}

void Progress::append_history(const std::string& curve, const solver::ResponsePoint& point) {
  if (!history_.is_open()) return;
  ++history_lines_[curve];
  history_ << row_of(history_columns(), {curve, point, Seconds(Clock::now() - begin_).count()})
           << '\n'
           << std::flush;
  if (history_) return;
  history_.close();
  const std::string sentence = "history.csv cannot be written any more; is the disk full?";
  warnings_.push_back(sentence);
  log(Level::warning, sentence);
}

}  // namespace microslip::pipelines
