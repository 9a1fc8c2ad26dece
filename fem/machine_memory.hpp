/// @file
/// How much memory there is, asked before it is taken: the system would end the program without a
/// word, not refuse an allocation.
#pragma once

#include <filesystem>
#include <string>

namespace microslip::fem {

struct AvailableMemory {
  double megabytes = 0.0;  ///< infinite where nothing says
  std::string limited_by;  ///< what is smallest: the machine, its control group, the address space
};

/// What the ranks on this machine can still take together without swapping: the smallest of what
/// the machine has available, what the memory limits of its control groups leave, and what their
/// address spaces (`ulimit -v`) leave: each has its own, taken to be as full as that of this one.
[[nodiscard]] AvailableMemory available_memory_here();

/// What the machines of all ranks can still give [MB]; the same on every rank.
/// Collective over MPI_COMM_WORLD.
[[nodiscard]] double available_memory_mb();

/// What the control groups of a process leave [MB], version 1 or 2: the smallest limit, less what
/// is used of it and could not be dropped, of its group and of those above. Infinite without one.
/// @param groups  as /proc/self/cgroup. @param mount  as /sys/fs/cgroup.
[[nodiscard]] double memory_left_in_groups(const std::filesystem::path& groups,
                                           const std::filesystem::path& mount);

}  // namespace microslip::fem
