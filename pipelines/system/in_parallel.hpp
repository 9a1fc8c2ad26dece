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

/// Runs task(i) for i < n on `jobs` threads; the first exception is thrown on when all have ended.
/// Threads that find no task left lend their cores to those still at work
/// (contact/spare_cores.hpp).
template <typename Task>
void in_parallel(std::size_t n, int jobs, const Task& task) {
  if (n == 0) return;
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < n; i = next++) {
      try {
        task(i);
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
    for (std::size_t i = 1; i < n_threads; ++i) {
      workers.emplace_back([&work] {
        const contact::CoreShare core(contact::CoreShare::Kind::taken);
        work();
      });
    }
    work();
    const contact::CoreShare core(contact::CoreShare::Kind::given_back);
    workers.clear();  // waits
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace microslip::pipelines
