/// @file
/// Cores that no task computes on, lent for a moment to whoever has work for them: both cores in
/// one curve while there are no other curves to trace.
#pragma once

#include <cstddef>
#include <functional>

namespace microslip::contact {

/// All threads of the process from now on compute on so many cores together. The calling thread has
/// one of them, the others are to spare. Nothing is lent before. While nothing else computes.
/// @param n_cores  ≥ 1.
void allow_cores(int n_cores);

/// The calling thread takes a core for itself for as long as this lives,
/// or gives back its own while it waits.
class CoreShare {
 public:
  enum class Kind { taken, given_back };
  explicit CoreShare(Kind kind);
  CoreShare(const CoreShare&) = delete;
  CoreShare& operator=(const CoreShare&) = delete;
  CoreShare(CoreShare&&) = delete;
  CoreShare& operator=(CoreShare&&) = delete;
  ~CoreShare();

 private:
  int n_;
};

/// task(i) for i < n, in any order, by the calling thread and by cores to spare; ended when all
/// have. What a task computes must not depend on who does.
/// The first exception is thrown on when all have ended.
void run_on_spare_cores(std::size_t n, const std::function<void(std::size_t)>& task);

}  // namespace microslip::contact
