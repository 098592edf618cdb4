#include "geometry/label_volume/child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

namespace fracbench {
namespace {

/// read() or write() until all is done; false at the end, or on an error.
template <typename Transfer, typename Byte>
bool transfer_all(const Transfer& transfer, int descriptor, Byte* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t done = transfer(descriptor, bytes, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
  return true;
}

/// In the child: no output, no core file, and a signal ends it as if nobody handled signals.
void make_quiet() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL}) ::signal(signal, SIG_DFL);
}

}  // namespace

Pipe::~Pipe() { ::close(descriptor_); }

bool Pipe::write(const void* bytes, std::size_t count) const {
  return transfer_all(::write, descriptor_, static_cast<const char*>(bytes), count);
}

bool Pipe::read(void* bytes, std::size_t count) const {
  return transfer_all(::read, descriptor_, static_cast<char*>(bytes), count);
}

bool run_in_child(const std::function<void(const Pipe&)>& work,
                  const std::function<bool(const Pipe&)>& collect) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  const pid_t child = ::fork();
  if (child < 0) {
    const int reason = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    throw std::system_error(reason, std::generic_category(), "fork");
  }
  if (child == 0) {
    ::close(ends[0]);
    make_quiet();
    int status = 1;
    try {
      const Pipe out(ends[1]);
      work(out);
      status = 0;
    } catch (...) {  // the parent sees what is missing
    }
    ::_exit(status);  // no destructors, no exit handlers: those are the parent's
  }
  ::close(ends[1]);
  bool collected = false;
  int status = 0;
  const auto wait_for_child = [&] {
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  };
  try {
    const Pipe in(ends[0]);
    collected = collect(in);
  } catch (...) {  // the pipe is closed by now, which ends a child that still writes
    wait_for_child();
    throw;
  }
  wait_for_child();
  return collected && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace fracbench
