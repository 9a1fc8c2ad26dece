#include "pipelines/system/interrupt.hpp"

#include <array>
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

void answer_by(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// The terminal was closed, the processor time that a batch system allows is over. Who starts a
/// program with one of them ignored, as nohup does, wants it to go on.
constexpr std::array unless_ignored{SIGHUP, SIGXCPU};

void answer_all_by(void (*handler)(int)) {
  answer_by(SIGINT, handler);
  answer_by(SIGTERM, handler);
  for (const int signal : unless_ignored) {
    if (!is_ignored(signal)) answer_by(signal, handler);
  }
}

}  // namespace

InterruptWatch::InterruptWatch() { answer_all_by(note_signal); }
InterruptWatch::~InterruptWatch() { answer_all_by(SIG_DFL); }

PromptEnd::PromptEnd() { end_is_promised = 1; }
PromptEnd::~PromptEnd() { end_is_promised = 0; }

StopOfThread::StopOfThread(std::stop_token stop) { own_stop = std::move(stop); }
StopOfThread::~StopOfThread() { own_stop = {}; }

bool interrupt_requested() { return requested != 0 || own_stop.stop_requested(); }
void request_interrupt() { requested = 1; }
void withdraw_interrupt() { requested = 0; }
bool interrupt_insisted() { return insisted != 0; }

}  // namespace microslip::pipelines
