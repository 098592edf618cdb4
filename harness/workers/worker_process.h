#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "harness/workers/message.h"
#include "harness/workers/output_tail.h"

namespace fracbench {

/// A worker and what it is connected by: a socket for messages, a pipe for what it prints. The
/// process is the leader of a group of its own, which is killed as a whole.
class WorkerProcess {
 public:
  /// Starts the program `command` (path and arguments). To be called on a thread that lives as long
  /// as the worker: the system ends it with its parent's thread. Throws std::system_error.
  explicit WorkerProcess(const std::vector<std::string>& command);
  /// Kills the group.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  ::pid_t id() const { return id_; }

  /// Puts a message on its way; wait() sends it.
  void send(const Message& message);

  /// Sends and receives until a message is there, the process has ended or the time is over.
  /// Throws DataError where what arrives is no message.
  std::optional<Message> wait(std::chrono::milliseconds time);

  /// Whether it has ended by itself; messages it sent before may still come from wait().
  bool ended() const { return ended_; }
  /// Whether it has closed its end of the socket, be it alive or not.
  bool hung_up() const { return hung_up_; }
  /// How it ended: "was ended by signal 11 (Segmentation fault)", "ended with exit code 0".
  std::string describe_end() const;
  std::optional<int> exit_code() const;
  std::optional<int> signal() const;

  /// What it printed since the last clear_output().
  std::string last_output() const { return output_.last_lines(); }
  void clear_output() { output_.clear(); }

  void kill();

 private:
  void send_waiting();
  void receive();
  void read_output();
  void take_end();

  ::pid_t id_ = -1;
  int socket_ = -1;
  int printed_ = -1;  ///< the pipe of its standard output and error
  int end_ = -1;      ///< readable once the process has ended (pidfd)
  bool ended_ = false;
  bool hung_up_ = false;  ///< the socket has given its last
  int status_ = 0;        ///< as of waitpid
  std::string waiting_;   ///< to be sent
  std::size_t sent_ = 0;  ///< of it
  MessageReader reader_;
  OutputTail output_;
};

}  // namespace fracbench
