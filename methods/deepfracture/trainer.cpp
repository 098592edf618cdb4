#include "methods/deepfracture/trainer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

#include "core/atomic_file.h"
#include "core/error.h"

extern char** environ;

namespace fracbench::deepfracture {

namespace {

// How often a request to stop is looked for while the program is silent.
constexpr int kPollMilliseconds = 100;
constexpr int kBadInput = 2;
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

/// A child process that does not outlive this object.
class Child {
 public:
  Child(std::vector<std::string> arguments, int output, int errors) {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    // The signals that this program listens to are blocked in it, and would be in the child.
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    sigset_t none;
    ::sigemptyset(&none);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    const int error =
        ::posix_spawn(&pid_, pointers[0], &actions, &attributes, pointers.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      pid_ = -1;
      throw std::system_error(error, std::generic_category(), pointers[0]);
    }
  }
  ~Child() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// As waitpid gives it.
  int wait() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }

 private:
  pid_t pid_ = -1;
};

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  return ends;
}

/// "epoch 12 200 0.00123 35.5": tells how far it is.
void report(const std::string& line, const Context& context) {
  std::istringstream words(line);
  std::string word;
  double done = 0, all = 0, loss = 0;
  if (words >> word >> done >> all >> loss && word == "epoch" && all > 0) {
    context.progress.update(fmt::format("training, loss {:.5f}", loss), done / all);
  }
}

/// Reads until both pipes are closed. Standard output comes as lines of progress; of what is said
/// to standard error the end is returned.
std::string follow(int output, int errors, const Context& context) {
  std::string line, said;
  std::array<pollfd, 2> ends = {{{output, POLLIN, 0}, {errors, POLLIN, 0}}};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    context.stop_if_asked();
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
      for (const char c : text) {
        if (c != '\n') {
          line += c;
          continue;
        }
        report(line, context);
        line.clear();
      }
    }
  }
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  return said;
}

}  // namespace

std::filesystem::path trainer_program() {
  if (const char* named = std::getenv("FRACBENCH_TRAINER")) return named;
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path program = self.parent_path() / "fracbench-train";
  if (::access(program.c_str(), X_OK) != 0) {
    throw InputError(
        fmt::format("deepfracture: the program '{}' is not there; build the target "
                    "fracbench-train, or name it in FRACBENCH_TRAINER",
                    program.string()));
  }
  return program;
}

void run_trainer(const TrainerCall& call, const Context& context) {
  const std::filesystem::path options = call.checkpoints / "options.json";
  write_file_atomically(options, call.options);
  const auto [output_read, output_write] = make_pipe();
  Descriptor output(output_read), output_end(output_write);
  const auto [errors_read, errors_write] = make_pipe();
  Descriptor errors(errors_read), errors_end(errors_write);
  Child child(
      {trainer_program().string(), "train", call.data_set.string(), "--out", call.model.string(),
       "--checkpoints", call.checkpoints.string(), "--options", options.string(), "--threads",
       std::to_string(context.threads), "--device", context.device, "--progress-lines"},
      output_end.get(), errors_end.get());
  output_end.close();
  errors_end.close();
  const std::string said = follow(output.get(), errors.get(), context);
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kBadInput) {
    throw InputError(fmt::format("deepfracture: {}", said));
  }
  throw MethodFailure(fmt::format("deepfracture: the training ended {} {}{}{}",
                                  WIFSIGNALED(status) ? "by signal" : "with exit code",
                                  WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status),
                                  said.empty() ? "" : ": ", said));
}

}  // namespace fracbench::deepfracture
