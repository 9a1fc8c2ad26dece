/// @file
/// Ctrl-C, SIGTERM, SIGHUP and SIGXCPU as a flag the stages look at.
#pragma once

#include <stop_token>

namespace microslip::pipelines {

/// While it lives the signals set the flag; a second one ends the process at once. Afterwards they
/// have their default action again: what follows the work, such as the end of a library,
/// can be ended.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  InterruptWatch(InterruptWatch&&) = delete;
  InterruptWatch& operator=(InterruptWatch&&) = delete;
};

/// While it lives no signal ends the process: its owner promises to, within a second,
/// and writes down what there is.
class PromptEnd {
 public:
  PromptEnd();
  ~PromptEnd();
  PromptEnd(const PromptEnd&) = delete;
  PromptEnd& operator=(const PromptEnd&) = delete;
  PromptEnd(PromptEnd&&) = delete;
  PromptEnd& operator=(PromptEnd&&) = delete;
};

/// While it lives a stop that is asked for is an interrupt to the thread that made it, and to no
/// other: all that looks for interrupts, or waits, ends there.
class StopOfThread {
 public:
  explicit StopOfThread(std::stop_token stop);
  ~StopOfThread();
  StopOfThread(const StopOfThread&) = delete;
  StopOfThread& operator=(const StopOfThread&) = delete;
  StopOfThread(StopOfThread&&) = delete;
  StopOfThread& operator=(StopOfThread&&) = delete;
};

[[nodiscard]] bool interrupt_requested();
/// As if a signal had come: for another rank than 0, which hears of none.
void request_interrupt();
/// For what it does next.
void withdraw_interrupt();
/// A second signal came: nothing is waited for any more.
[[nodiscard]] bool interrupt_insisted();

}  // namespace microslip::pipelines
