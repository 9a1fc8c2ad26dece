/// @file
/// What a run ran on: processor, memory, libraries. No host name, no paths.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace microslip::pipelines {

struct Machine {
  std::string processor;   ///< model name as the system gives it
  unsigned cores = 0;      ///< that this process may use
  double memory_mb = 0.0;  ///< installed
  std::string blas;        ///< e.g. "OpenBLAS 0.3.21 … Haswell", or "unknown (not OpenBLAS)"
  int blas_threads = 1;
};

[[nodiscard]] Machine describe_machine();

/// Name and version of the libraries the program is built with.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> library_versions();

/// Largest resident memory from its construction on: of this process, or of a child that ended
/// meanwhile where that is more. Where the system does not let the high-water mark be reset, the
/// largest since the process began. One at a time: a new one resets the mark.
class MemoryGauge {
 public:
  MemoryGauge();
  [[nodiscard]] double peak_mb() const;  ///< [MB = 10⁶ bytes]

 private:
  long children_before_ = 0;
};

}  // namespace microslip::pipelines
