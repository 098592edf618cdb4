#include "harness/workers/serve_cells.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "core/error.h"
#include "core/process_tree.h"
#include "harness/cell_executor.h"
#include "harness/workers/cell_request.h"
#include "harness/workers/message.h"
#include "harness/workers/tree_bytes.h"

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kProgressInterval = std::chrono::milliseconds(100);
constexpr std::size_t kReadAtOnce = 1 << 16;
constexpr int kLookAtSocket = 1000;  // ms

/// Stacks of threads and what the allocators hold back, on top of the memory that a cell may take.
constexpr std::uint64_t kAllowance = 512 << 20;

/// Ends this process and all of its group: what the method started must not outlive it.
void end_group(int) {
  ::kill(0, SIGKILL);
  ::_exit(1);
}

/// The supervisor is gone when its end of the socket is, and this process is then told by a signal
/// as well, in case its threads are stuck.
void end_with_supervisor() {
  struct sigaction action = {};
  action.sa_handler = end_group;
  ::sigaction(SIGTERM, &action, nullptr);
  end_with_parent();
  std::thread([] {
    // Not for ever at a time: a socket stays open while it is polled, and the supervisor could not
    // tell that this process had closed it.
    ::pollfd end{kWorkerSocket, POLLRDHUP, 0};
    while (end.revents == 0) ::poll(&end, 1, kLookAtSocket);
    if ((end.revents & POLLNVAL) == 0) end_group(0);
  }).detach();
}

/// bad_alloc ends here where it leaves a noexcept function or a thread.
[[noreturn]] void on_terminate() {
  if (const auto error = std::current_exception()) {
    try {
      std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
      ::_exit(kNoMemoryExitCode);
    } catch (const std::exception& known) {
      std::fprintf(stderr, "terminated by an exception: %s\n", known.what());
    } catch (...) {
      std::fputs("terminated by an exception of an unknown kind\n", stderr);
    }
  }
  std::abort();
}

std::uint64_t private_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmData:")) return std::stoull(line.substr(7)) * 1024;
  }
  return 0;
}

/// Makes requests for far too much memory fail with bad_alloc at once; what is really used is
/// watched by the supervisor.
void limit_memory(std::uint64_t bytes) {
  ::rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<::rlim_t>(private_memory() + bytes + kAllowance, limit.rlim_max);
  ::setrlimit(RLIMIT_DATA, &limit);
}

void send(const Message& message) {
  const std::string bytes = to_bytes(message);
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ::ssize_t count =
        ::send(kWorkerSocket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) end_group(0);
    sent += static_cast<std::size_t>(count);
  }
}

Message receive(MessageReader& reader) {
  std::string buffer(kReadAtOnce, '\0');
  while (true) {
    if (auto message = reader.next()) return std::move(*message);
    const ::ssize_t count = ::read(kWorkerSocket, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) end_group(0);
    reader.add(std::string_view(buffer).substr(0, static_cast<std::size_t>(count)));
  }
}

/// Passes progress on, not more often than anybody can read it.
class SentProgress : public Progress {
 public:
  void update(std::string_view what, double fraction) override {
    const std::scoped_lock lock(mutex_);
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + kProgressInterval;
    std::string body(sizeof fraction, '\0');
    std::memcpy(body.data(), &fraction, sizeof fraction);
    body += what.substr(0, 200);
    send({MessageKind::progress, std::move(body)});
  }

 private:
  std::mutex mutex_;
  Clock::time_point next_;
};

void send_phase(CellPhase phase) {
  send({MessageKind::phase, std::string(1, static_cast<char>(phase))});
}

[[noreturn]] void serve(const Catalog& catalog) {
  MessageReader reader;
  WorkerJob job = decode_job(receive(reader).body, catalog);
  limit_memory(job.memory);
  CellExecutor executor(job.plan, catalog, true, send_phase);
  while (true) {
    const Cell cell = decode_cell(receive(reader).body, job.plan);
    SentProgress progress;
    Message answer;
    try {
      const Record record = executor.execute(cell, progress, {});
      answer = {MessageKind::record, to_bytes(to_tree(record))};
    } catch (const InputError& error) {
      answer = {MessageKind::refusal, error.what()};
    }
    send(answer);
  }
}

}  // namespace

int serve_cells(const Catalog& catalog) {
  struct ::stat socket = {};
  if (::fstat(kWorkerSocket, &socket) != 0 || !S_ISSOCK(socket.st_mode)) {
    fmt::print(stderr, "fracbench worker: is started by 'fracbench run' and by nobody else\n");
    return 2;
  }
  ::fcntl(kWorkerSocket, F_SETFD, FD_CLOEXEC);
  ::setpgid(0, 0);
  end_with_supervisor();
  std::set_terminate(on_terminate);
  const ::rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  try {
    serve(catalog);
  } catch (const std::bad_alloc&) {
    return kNoMemoryExitCode;
  } catch (const std::exception& error) {
    fmt::print(stderr, "fracbench worker: {}\n", error.what());
    return 1;
  }
}

}  // namespace fracbench
