/// @file
/// A script or program as a child process with a time limit.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace microslip::pipelines {

struct ChildResult {
  bool succeeded = false;
  std::string
      message{};      ///< why not: the last line of its standard error, its signal, or the limit
  int exit_code = 0;  ///< where it ended by itself
};

/// Runs `command` (program, arguments) with nothing on standard input and waits for its end; ends
/// it when the limit has passed. Its output is kept for the message, not shown.
/// @throws InterruptedError  an interrupt was asked for; the child has been ended.
[[nodiscard]] ChildResult run_child(const std::vector<std::string>& command,
                                    std::chrono::milliseconds limit);

}  // namespace microslip::pipelines
