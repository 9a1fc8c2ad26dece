/// @file
/// Ctrl-C and SIGTERM as a flag the stages look at. A second signal ends the process at once.
#pragma once

namespace microslip::pipelines {

/// Installs the handlers. Call once, from main.
void watch_for_interrupts();

[[nodiscard]] bool interrupt_requested();

}  // namespace microslip::pipelines
