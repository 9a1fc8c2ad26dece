#include "fem/machine_memory.hpp"

#include <mpi.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "fem/process/mpi_error.hpp"
#include "fem/ranks.hpp"

namespace microslip::fem {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double kibibyte = 1.024e-3;  // [MB]

/// A line "KEY: number kB" of a file of /proc [MB]; infinite where there is none.
double line_of(const char* path, std::string_view wanted) {
  std::ifstream file(path);
  std::string key;
  double kilobytes = 0.0;
  std::string rest;
  while (file >> key) {
    if (key == wanted && file >> kilobytes) return kilobytes * kibibyte;
    std::getline(file, rest);
  }
  return infinite;
}

double left_in_address_space() {
  rlimit space{};
  if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY) return infinite;
  const double used = line_of("/proc/self/status", "VmSize:");
  return std::max(0.0, 1e-6 * static_cast<double>(space.rlim_cur) - used);
}

/// The one number of a file [bytes]; infinite where there is none ("max", no such file).
double number_in(const std::filesystem::path& path) {
  std::ifstream file(path);
  double number = 0.0;
  return file >> number ? number : infinite;
}

/// Of memory.stat [bytes]: cached files, which go when memory is wanted.
double droppable(const std::filesystem::path& group) {
  std::ifstream file(group / "memory.stat");
  std::string key;
  double number = 0.0;
  double sum = 0.0;
  while (file >> key >> number) {
    if (key == "inactive_file") sum += number;
  }
  return sum;
}

/// One group, by the names its version has for limit and use [MB].
double left_in_group(const std::filesystem::path& group, const char* limit, const char* use) {
  const double most = number_in(group / limit);
  const double used = number_in(group / use);
  constexpr double no_limit = 1e18;  // version 1 says so with the largest number it has
  if (!(most < no_limit) || used == infinite) return infinite;
  return 1e-6 * std::max(0.0, most - std::max(0.0, used - droppable(group)));
}

double left_up_to(const std::filesystem::path& root, const std::string& path, const char* limit,
                  const char* use) {
  double least = left_in_group(root, limit, use);
  std::filesystem::path group = root;
  for (const auto& part : std::filesystem::path(path).relative_path()) {
    group /= part;
    least = std::min(least, left_in_group(group, limit, use));
  }
  return least;
}

}  // namespace

double memory_left_in_groups(const std::filesystem::path& groups,
                             const std::filesystem::path& mount) {
  std::ifstream file(groups);
  double least = infinite;
  for (std::string line; std::getline(file, line);) {  // number:controllers:path
    const auto first = line.find(':');
    const auto second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string path = line.substr(second + 1);
    if (controllers.empty()) {
      least = std::min(least, left_up_to(mount, path, "memory.max", "memory.current"));
    } else if (controllers.find("memory") != std::string::npos) {
      least = std::min(least, left_up_to(mount / "memory", path, "memory.limit_in_bytes",
                                         "memory.usage_in_bytes"));
    }
  }
  return least;
}

AvailableMemory available_memory_here() {
  AvailableMemory least{line_of("/proc/meminfo", "MemAvailable:"), "what the machine has left"};
  const auto compare = [&](double megabytes, const char* by) {
    if (megabytes < least.megabytes) least = {megabytes, by};
  };
  compare(memory_left_in_groups("/proc/self/cgroup", "/sys/fs/cgroup"),
          "the limit of the control group");
  compare(n_ranks_here() * left_in_address_space(), "the limit of the address space, ulimit -v");
  return least;
}

double available_memory_mb() {
  const double share = available_memory_here().megabytes / n_ranks_here();
  double total = 0.0;
  check_mpi(MPI_Allreduce(&share, &total, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD));
  return total;
}

}  // namespace microslip::fem
