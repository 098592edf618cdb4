#pragma once

#include <stop_token>
#include <thread>

namespace fracbench {

/// Turns SIGINT and SIGTERM into a request to stop. Work that has not stopped within a second, and
/// any work at a second signal, is ended with the process. To be made once, before any other thread
/// is started.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::thread listener_;
};

}  // namespace fracbench
