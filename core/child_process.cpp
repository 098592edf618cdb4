#include "core/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "core/error.h"
#include "core/process_tree.h"

extern char** environ;

namespace fracbench {

namespace {

// How often a request to stop is looked for while the program is silent.
constexpr int kPollMilliseconds = 100;
constexpr std::size_t kMostSaid = 2000;

/// One end of a pipe.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }
  void close() {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

/// A process group that does not outlive this object.
class Child {
 public:
  Child(std::vector<std::string> arguments, const std::filesystem::path& folder, int output,
        int errors) {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    if (!folder.empty()) ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    // The signals that this program listens to are blocked in it, and would be in the child.
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    sigset_t none;
    ::sigemptyset(&none);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    const int error =
        ::posix_spawnp(&pid_, pointers[0], &actions, &attributes, pointers.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      pid_ = -1;
      throw std::system_error(error, std::generic_category(), pointers[0]);
    }
  }
  ~Child() {
    if (pid_ < 0) return;
    kill_all();
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// As waitpid gives it; what is left of its group is killed. Throws Cancelled.
  int wait(const std::stop_token& stop) {
    int status = 0;
    while (true) {
      const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
      if (ended == pid_) break;
      if (ended < 0 && errno != EINTR) break;
      if (stop.stop_requested()) throw Cancelled();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(-pid_, SIGKILL);
    pid_ = -1;
    return status;
  }

 private:
  /// With those that left its group.
  void kill_all() const {
    const std::vector<pid_t> others = descendants(pid_);
    ::kill(-pid_, SIGKILL);
    for (const pid_t other : others) ::kill(other, SIGKILL);
  }

  pid_t pid_ = -1;
};

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  return ends;
}

/// Reads until both pipes are closed. Lines of standard output are passed on; of what is said to
/// standard error the end is returned.
std::string follow(int output, int errors, const ChildOptions& options) {
  std::string line, said;
  std::array<pollfd, 2> ends = {{{output, POLLIN, 0}, {errors, POLLIN, 0}}};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (options.stop.stop_requested()) throw Cancelled();
    if (::poll(ends.data(), ends.size(), kPollMilliseconds) < 0 && errno != EINTR) break;
    for (pollfd& end : ends) {
      if (end.fd < 0 || end.revents == 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t count = ::read(end.fd, buffer.data(), buffer.size());
      if (count <= 0) {
        end.fd = -1;
        continue;
      }
      const std::string_view text(buffer.data(), static_cast<std::size_t>(count));
      if (&end == &ends[1]) {
        said += text;
        if (said.size() > kMostSaid) said.erase(0, said.size() - kMostSaid);
        continue;
      }
      if (!options.on_line) continue;
      for (const char c : text) {
        if (c != '\n') {
          line += c;
          continue;
        }
        options.on_line(line);
        line.clear();
      }
    }
  }
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  return said;
}

}  // namespace

std::string ChildResult::describe() const {
  return fmt::format("{} {}{}{}", signal != 0 ? "by signal" : "with exit code",
                     signal != 0 ? signal : exit_code, said.empty() ? "" : ": ", said);
}

ChildResult run_child(std::vector<std::string> arguments, const ChildOptions& options) {
  const auto [output_read, output_write] = make_pipe();
  Descriptor output(output_read), output_end(output_write);
  const auto [errors_read, errors_write] = make_pipe();
  Descriptor errors(errors_read), errors_end(errors_write);
  Child child(std::move(arguments), options.folder, output_end.get(), errors_end.get());
  output_end.close();
  errors_end.close();
  ChildResult result{.said = follow(output.get(), errors.get(), options)};
  const int status = child.wait(options.stop);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

}  // namespace fracbench
