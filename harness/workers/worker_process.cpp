#include "harness/workers/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/process_tree.h"
#include "harness/workers/serve_cells.h"

extern char** environ;

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kReadAtOnce = 1 << 16;
/// Of what was printed, at a time: a worker that prints without end must not keep its supervisor.
constexpr int kReadsOfOutput = 16;
/// Several times what the socket holds, so that an ended worker's last message is read whole.
constexpr int kReadsOfMessages = 64;
/// Descriptors of the supervisor lie above those that the worker gets.
constexpr int kFirstDescriptor = 16;

[[noreturn]] void fail(std::string_view what, int error = errno) {
  throw std::system_error(error, std::generic_category(),
                          fmt::format("starting a worker: {}", what));
}

/// Closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }
  int release() { return std::exchange(value_, -1); }

 private:
  int value_;
};

/// The same open file under a number that no worker has.
int moved_up(int descriptor) {
  const Descriptor old(descriptor);
  const int moved = ::fcntl(old.get(), F_DUPFD_CLOEXEC, kFirstDescriptor);
  if (moved < 0) fail("too many open files");
  return moved;
}

class FileActions {
 public:
  FileActions() { ::posix_spawn_file_actions_init(&value_); }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&value_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  ::posix_spawn_file_actions_t* get() { return &value_; }

 private:
  ::posix_spawn_file_actions_t value_;
};

class Attributes {
 public:
  Attributes() {
    ::posix_spawnattr_init(&value_);
    ::sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&value_, &none);
    ::posix_spawnattr_setsigdefault(&value_, &all);
    ::posix_spawnattr_setpgroup(&value_, 0);
    ::posix_spawnattr_setflags(
        &value_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Attributes() { ::posix_spawnattr_destroy(&value_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const ::posix_spawnattr_t* get() const { return &value_; }

 private:
  ::posix_spawnattr_t value_;
};

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& command) {
  int pair[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) fail("no socket");
  Descriptor ours(moved_up(pair[0]));
  const Descriptor theirs(moved_up(pair[1]));
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) fail("no pipe");
  Descriptor read_end(moved_up(pipe[0]));
  const Descriptor write_end(moved_up(pipe[1]));
  ::fcntl(read_end.get(), F_SETFL, O_NONBLOCK);

  FileActions actions;
  ::posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(actions.get(), write_end.get(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(actions.get(), write_end.get(), STDERR_FILENO);
  ::posix_spawn_file_actions_adddup2(actions.get(), theirs.get(), kWorkerSocket);
  ::posix_spawn_file_actions_addclosefrom_np(actions.get(), kWorkerSocket + 1);
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  const Attributes attributes;
  const int error = ::posix_spawn(&id_, command.at(0).c_str(), actions.get(), attributes.get(),
                                  arguments.data(), environ);
  if (error != 0) fail(command[0], error);
  // The header of glibc 2.36 is not made for C++.
  end_ = static_cast<int>(::syscall(SYS_pidfd_open, id_, 0));
  if (end_ < 0) {
    const int reason = errno;
    ::kill(-id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
    fail("pidfd_open", reason);
  }
  socket_ = ours.release();
  printed_ = read_end.release();
}

WorkerProcess::~WorkerProcess() {
  kill();
  for (const int descriptor : {socket_, printed_, end_}) ::close(descriptor);
}

void WorkerProcess::send(const Message& message) { waiting_ += to_bytes(message); }

std::optional<Message> WorkerProcess::wait(std::chrono::milliseconds time) {
  const auto deadline = Clock::now() + time;
  while (true) {
    if (auto message = reader_.next()) return message;
    if (ended_) return std::nullopt;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    const short wanted = static_cast<short>(POLLIN | (waiting_.empty() ? 0 : POLLOUT));
    ::pollfd watched[] = {
        {hung_up_ ? -1 : socket_, wanted, 0}, {printed_, POLLIN, 0}, {end_, POLLIN, 0}};
    const int ready = ::poll(watched, 3, std::max(0, static_cast<int>(left.count())));
    if (ready == 0) return std::nullopt;
    if (ready < 0) continue;  // a signal
    if (watched[2].revents != 0) {
      // What it said last is still in the pipes.
      receive();
      read_output();
      take_end();
      continue;
    }
    if ((watched[0].revents & POLLOUT) != 0) send_waiting();
    if ((watched[0].revents & ~POLLOUT) != 0) receive();
    if (watched[1].revents != 0) read_output();
    if (left.count() <= 0) return reader_.next();
  }
}

void WorkerProcess::send_waiting() {
  while (sent_ < waiting_.size()) {
    const ::ssize_t count = ::send(socket_, waiting_.data() + sent_, waiting_.size() - sent_,
                                   MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count <= 0) break;  // it has ended, or will be found not to answer
    sent_ += static_cast<std::size_t>(count);
  }
  std::string().swap(waiting_);
  sent_ = 0;
}

void WorkerProcess::receive() {
  char buffer[kReadAtOnce];
  for (int k = 0; k < kReadsOfMessages && !hung_up_; ++k) {
    const ::ssize_t count = ::recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count <= 0) {
      hung_up_ = true;
      return;
    }
    reader_.add(std::string_view(buffer, static_cast<std::size_t>(count)));
  }
}

void WorkerProcess::read_output() {
  char buffer[kReadAtOnce];
  for (int k = 0; k < kReadsOfOutput && printed_ >= 0; ++k) {
    const ::ssize_t count = ::read(printed_, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count <= 0) {
      ::close(printed_);
      printed_ = -1;
      return;
    }
    output_.add(std::string_view(buffer, static_cast<std::size_t>(count)));
  }
}

void WorkerProcess::take_end() {
  if (ended_) return;
  // What is left of its group goes with it, while the number of the group is still taken.
  ::kill(-id_, SIGKILL);
  while (::waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
  }
  ended_ = true;
}

void WorkerProcess::kill() {
  if (ended_) return;
  const std::vector<::pid_t> others = descendants(id_);  // they may have left the group
  ::kill(-id_, SIGKILL);
  ::kill(id_, SIGKILL);  // it may have, too
  for (const ::pid_t other : others) ::kill(other, SIGKILL);
  take_end();
}

std::optional<int> WorkerProcess::exit_code() const {
  if (!ended_ || !WIFEXITED(status_)) return std::nullopt;
  return WEXITSTATUS(status_);
}

std::optional<int> WorkerProcess::signal() const {
  if (!ended_ || !WIFSIGNALED(status_)) return std::nullopt;
  return WTERMSIG(status_);
}

std::string WorkerProcess::describe_end() const {
  if (const auto number = signal()) {
    return fmt::format("was ended by signal {} ({})", *number, ::strsignal(*number));
  }
  return fmt::format("ended with exit code {}", exit_code().value_or(-1));
}

}  // namespace fracbench
