/// @file
/// The wall time a run may take, for the stages to look at.
#pragma once

#include <chrono>

namespace microslip::pipelines {

/// From now on. @param seconds  > 0; infinite: no end.
///              @param spent    so many of them are over: of a run that has begun elsewhere.
void begin_deadline(double seconds, double spent = 0.0);
/// Seconds since begin_deadline(), and how many are left; infinite without an end.
[[nodiscard]] double seconds_spent();
[[nodiscard]] double seconds_left();

/// The same without a tenth of the time, at least two seconds or half of a shorter one, that is
/// left to write down what there is.
[[nodiscard]] double seconds_to_work();

/// Nothing that takes long is to be begun or gone on with: seconds_to_work() are over.
[[nodiscard]] bool time_is_short();

/// The same, asked by what then leaves something out: remembered until the next begin_deadline().
[[nodiscard]] bool cut_short();
/// Remembered likewise, of what would take longer than there is time. @return true
bool leave_out();
[[nodiscard]] bool was_cut_short();

/// From now on so many things of a kind are to share the time there is, those of now included.
/// @param n  > 0; infinite time is not shared. With begin_deadline(): one.
void share_time_among(double n);
/// What each may take of seconds_to_work(); infinite where one has all of it.
[[nodiscard]] double share_of_time();

/// What one thing may take, from where this is made.
class TimeLimit {
 public:
  /// @param seconds  of wall time; infinite: no limit.
  explicit TimeLimit(double seconds);
  [[nodiscard]] bool is_over() const;

 private:
  std::chrono::steady_clock::time_point begin_;
  double seconds_;
};

}  // namespace microslip::pipelines
