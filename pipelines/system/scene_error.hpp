/// @file
/// Exit codes of the program (interfaces.md section 1) and the errors that carry them.
#pragma once

#include <stdexcept>
#include <string>

namespace microslip::pipelines {

enum class ExitCode : int {
  complete = 0,
  bad_input = 1,
  refused = 2,     ///< on physical grounds
  incomplete = 3,  ///< partial results valid and marked
  exhausted = 4,   ///< time, memory or disk
  internal = 5,
};

/// Bad input: "file:line: key: what was expected; did you mean …".
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Well-formed input that physics refuses: rigid-body mode held by nothing, …
class RefusedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// No disk, memory or time left; unwritable output.
class ExhaustedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ctrl-C or a termination signal; what was complete is kept.
class InterruptedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace microslip::pipelines
