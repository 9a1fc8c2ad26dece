#include "pipelines/system/interrupt.hpp"

#include <csignal>
#include <cstdlib>
#include <utility>

#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {
namespace {

volatile std::sig_atomic_t requested = 0;
volatile std::sig_atomic_t insisted = 0;
volatile std::sig_atomic_t end_is_promised = 0;
thread_local std::stop_token own_stop;  // of one that nobody asks, at first

extern "C" void note_signal(int /*signal*/) {
  if (requested != 0 && end_is_promised == 0) std::_Exit(static_cast<int>(ExitCode::incomplete));
  if (requested != 0) insisted = 1;
  requested = 1;
}

void answer_by(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch() { answer_by(note_signal); }
InterruptWatch::~InterruptWatch() { answer_by(SIG_DFL); }

PromptEnd::PromptEnd() { end_is_promised = 1; }
PromptEnd::~PromptEnd() { end_is_promised = 0; }

StopOfThread::StopOfThread(std::stop_token stop) { own_stop = std::move(stop); }
StopOfThread::~StopOfThread() { own_stop = {}; }

bool interrupt_requested() { return requested != 0 || own_stop.stop_requested(); }
void request_interrupt() { requested = 1; }
void withdraw_interrupt() { requested = 0; }
bool interrupt_insisted() { return insisted != 0; }

}  // namespace microslip::pipelines
