#include "pipelines/system/deadline.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

namespace microslip::pipelines {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<double> allowed{std::numeric_limits<double>::infinity()};
std::atomic<Clock::time_point> begun{Clock::now()};
std::atomic<bool> was_cut{false};
std::atomic<double> sharing{1.0};

}  // namespace

void begin_deadline(double seconds, double spent) {
  const auto before =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(spent));
  begun = Clock::now() - before;
  allowed = seconds;
  was_cut = false;
  sharing = 1.0;
}

void share_time_among(double n) { sharing = n; }

double share_of_time() {
  const double n = sharing;
  return n > 1.0 ? std::max(seconds_to_work() / n, 0.0) : std::numeric_limits<double>::infinity();
}

double seconds_spent() {
  return std::chrono::duration<double>(Clock::now() - begun.load()).count();
}

double seconds_left() { return allowed - seconds_spent(); }

double seconds_to_work() {
  if (std::isinf(allowed.load())) return allowed;
  constexpr double share = 0.1;
  constexpr double least = 2.0;
  constexpr double most = 0.5;  // of a budget of few seconds
  const double writing = std::max(share * allowed, std::min(least, most * allowed));
  return seconds_left() - writing;
}

bool time_is_short() { return seconds_to_work() < 0.0; }

bool cut_short() {
  if (!time_is_short()) return false;
  was_cut = true;
  return true;
}

bool leave_out() {
  was_cut = true;
  return true;
}

bool was_cut_short() { return was_cut; }

TimeLimit::TimeLimit(double seconds) : begin_(Clock::now()), seconds_(seconds) {}

bool TimeLimit::is_over() const {
  return std::chrono::duration<double>(Clock::now() - begin_).count() > seconds_;
}

}  // namespace microslip::pipelines
