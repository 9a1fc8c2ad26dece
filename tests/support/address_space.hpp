/// @file
/// Little address space, as under ulimit -v.
#pragma once

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace microslip::test {

/// What this process has taken [MB].
inline double address_space_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmSize:")) return 1.024e-3 * std::stod(line.substr(7));
  }
  return 0.0;
}

/// Leaves so much address space while it lives.
class Room {
 public:
  explicit Room(double megabytes) {
    getrlimit(RLIMIT_AS, &before_);
    rlimit little = before_;
    little.rlim_cur = static_cast<rlim_t>(1e6 * (address_space_mb() + megabytes));
    setrlimit(RLIMIT_AS, &little);
  }
  ~Room() { setrlimit(RLIMIT_AS, &before_); }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
  Room(Room&&) = delete;
  Room& operator=(Room&&) = delete;

 private:
  rlimit before_{};
};

}  // namespace microslip::test
