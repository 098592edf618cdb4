#include "app/interrupt.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace fracbench {

namespace {

/// Wakes the listener when the program ends by itself.
constexpr int kWakeUp = SIGUSR2;

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
    for (int signal = 0; sigwait(&waited, &signal) == 0 && signal != kWakeUp;) {
      if (!source_.request_stop()) std::_Exit(128 + signal);
      std::fputs("\nfracbench: stopping; once more to stop at once\n", stderr);
    }
  });
}

Interrupt::~Interrupt() {
  pthread_kill(listener_.native_handle(), kWakeUp);
  listener_.join();
}

}  // namespace fracbench
