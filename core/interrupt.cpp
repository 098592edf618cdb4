#include "core/interrupt.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace fracbench {

namespace {

// The exit code of work that was stopped, in all our programs.
constexpr int kNotEverythingDone = 4;

/// Wakes the listener when the program ends by itself.
constexpr int kWakeUp = SIGUSR2;

/// How long work may take to notice that it was asked to stop. Libraries cannot be interrupted, and
/// what is half written is of no harm: it has no final name yet.
constexpr timespec kPatience = {.tv_sec = 0, .tv_nsec = 800'000'000};

sigset_t listened_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, kWakeUp}) sigaddset(&set, signal);
  return set;
}

}  // namespace

Interrupt::Interrupt() {
  // Blocked here, and so in every thread that is started later, the signals are left to the
  // listener, which may do what a signal handler must not.
  const sigset_t set = listened_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  listener_ = std::thread([this] {
    const sigset_t waited = listened_signals();
    int signal = 0;
    if (sigwait(&waited, &signal) != 0 || signal == kWakeUp) return;
    source_.request_stop();
    std::fputs("\nfracbench: stopping; once more to stop at once\n", stderr);
    signal = sigtimedwait(&waited, nullptr, &kPatience);
    if (signal == kWakeUp) return;
    std::_Exit(signal > 0 ? 128 + signal : kNotEverythingDone);
  });
}

Interrupt::~Interrupt() {
  pthread_kill(listener_.native_handle(), kWakeUp);
  listener_.join();
}

}  // namespace fracbench
