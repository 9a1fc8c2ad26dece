#include "pipelines/system/interrupt.hpp"

#include <csignal>
#include <cstdlib>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

volatile std::sig_atomic_t requested = 0;

extern "C" void note_signal(int /*signal*/) {
  if (requested != 0) std::_Exit(static_cast<int>(ExitCode::incomplete));
  requested = 1;
}

}  // namespace

void watch_for_interrupts() {
  struct sigaction action = {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupt_requested() { return requested != 0; }

}  // namespace microslip::pipelines
