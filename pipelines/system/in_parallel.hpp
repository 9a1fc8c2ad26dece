/// @file
/// Independent tasks on a few threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "contact/spare_cores.hpp"

namespace microslip::pipelines {

/// Runs task(i, 0) for i < n on `jobs` threads, and task(i, k) on one more for each of k = 1 …
/// n_helpers, which has it done elsewhere; the first exception is thrown on when all have ended.
/// Threads that find no task left lend their cores to those still at work
/// (contact/spare_cores.hpp); a helper counts as one core while it has tasks.
template <typename Task>
void in_parallel(std::size_t n, int jobs, int n_helpers, const Task& task) {
  if (n == 0) return;
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&](int helper) {
    for (std::size_t i = next++; i < n; i = next++) {
      try {
        task(i, helper);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = n;
      }
    }
  };
  const auto n_threads = std::clamp<std::size_t>(static_cast<std::size_t>(std::max(jobs, 1)), 1, n);
  {
    std::vector<std::jthread> workers;
    const auto start = [&](int helper) {
      workers.emplace_back([&work, helper] {
        const contact::CoreShare core(contact::CoreShare::Kind::taken);
        work(helper);
      });
    };
    for (int helper = 1; helper <= n_helpers; ++helper) start(helper);
    for (std::size_t i = 1; i < n_threads; ++i) start(0);
    work(0);
    const contact::CoreShare core(contact::CoreShare::Kind::given_back);
    workers.clear();  // waits
  }
  if (failure) std::rethrow_exception(failure);
}

/// The same without helpers: task(i).
template <typename Task>
void in_parallel(std::size_t n, int jobs, const Task& task) {
  in_parallel(n, jobs, 0, [&](std::size_t i, int /*helper*/) { task(i); });
}

}  // namespace microslip::pipelines
