#include "harness/conformance/write_watch.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <system_error>
#include <tuple>

#include "core/error.h"
#include "harness/conformance/writing_calls.h"

namespace fracbench::conformance {

namespace {

namespace fs = std::filesystem;

/// What changes whenever a file does; of a folder or a device only which one it is.
using Mark = std::tuple<dev_t, ino_t, time_t, long>;

/// Nothing for what does not exist.
std::optional<Mark> mark_of(const fs::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return std::nullopt;
  if (!S_ISREG(found.st_mode)) return Mark{found.st_dev, found.st_ino, 0, 0};
  return Mark{found.st_dev, found.st_ino, found.st_ctim.tv_sec, found.st_ctim.tv_nsec};
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return path.string().starts_with(folder.string() + "/");
}

/// Whether it is on a disk, and not what the kernel makes up.
bool is_kept(const fs::path& path) {
  return !is_below(path, "/proc") && !is_below(path, "/sys") &&
         (!is_below(path, "/dev") || is_below(path, "/dev/shm"));
}

/// How the places that were written to looked before.
class Places {
 public:
  explicit Places(const fs::path& allowed) : allowed_(fs::canonical(allowed)) {}

  void note(const fs::path& path) {
    if (is_kept(path) && !is_below(path, allowed_)) before_.try_emplace(path, mark_of(path));
  }
  std::vector<std::string> changes() const {
    std::vector<std::string> list;
    for (const auto& [path, before] : before_) {
      const std::optional<Mark> now = mark_of(path);
      if (now == before) continue;
      list.push_back(fmt::format("{} {}",
                                 !before ? "leaves"
                                 : !now  ? "removes"
                                         : "changes",
                                 path.string()));
    }
    return list;
  }

 private:
  fs::path allowed_;
  std::map<fs::path, std::optional<Mark>> before_;
};

/// What a process says to another one: words and perhaps an open file.
struct Message {
  std::string words;
  int descriptor = -1;
};

/// A message with room for one descriptor beside its words, which are those of `words`.
struct Envelope {
  explicit Envelope(iovec& words) {
    header.msg_iov = &words;
    header.msg_iovlen = 1;
    header.msg_control = control;
    header.msg_controllen = sizeof control;
  }
  msghdr header{};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))]{};
};

void send(int socket, Message message) {
  message.words.resize(std::min<std::size_t>(message.words.size(), 4000));
  iovec words{message.words.data(), message.words.size()};
  Envelope envelope(words);
  if (message.descriptor < 0) {
    envelope.header.msg_controllen = 0;
  } else {
    cmsghdr* part = CMSG_FIRSTHDR(&envelope.header);
    part->cmsg_level = SOL_SOCKET;
    part->cmsg_type = SCM_RIGHTS;
    part->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(part), &message.descriptor, sizeof(int));
  }
  ::sendmsg(socket, &envelope.header, MSG_NOSIGNAL);
}

/// Empty where the other side has ended.
Message receive(int socket) {
  std::array<char, 4096> buffer;
  iovec words{buffer.data(), buffer.size()};
  Envelope envelope(words);
  ssize_t count = 0;
  while ((count = ::recvmsg(socket, &envelope.header, MSG_CMSG_CLOEXEC)) < 0 && errno == EINTR) {
  }
  Message message;
  if (count > 0) message.words.assign(buffer.data(), static_cast<std::size_t>(count));
  if (const cmsghdr* part = CMSG_FIRSTHDR(&envelope.header); part && count > 0) {
    std::memcpy(&message.descriptor, CMSG_DATA(part), sizeof(int));
  }
  return message;
}

/// How the work ended: the first letter of the last words.
constexpr char kGood = 'g', kFailed = 'f', kBadInput = 'b';

[[noreturn]] void end(int socket, char how, const std::string& why) {
  send(socket, {how + why});
  ::_exit(0);
}

[[noreturn]] void be_the_copy(int socket, const std::function<void()>& work) {
  const int listener = ask_before_writing();
  if (listener < 0) end(socket, kFailed, std::strerror(errno));
  send(socket, {"listen", listener});
  ::close(listener);
  try {
    work();
  } catch (const InputError& error) {
    end(socket, kBadInput, error.what());
  } catch (const std::exception& error) {
    end(socket, kFailed, error.what());
  }
  end(socket, kGood, "");
}

/// Answers the system until the other end of the socket says its last words, which are returned.
std::string attend(int socket, int listener, Places& places, std::string& unseen) {
  std::array<pollfd, 2> ends = {{{socket, POLLIN, 0}, {listener, POLLIN, 0}}};
  while (true) {
    if (::poll(ends.data(), ends.size(), -1) < 0) continue;
    if (ends[1].revents & POLLIN) {
      seccomp_notif call{};
      if (::ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &call) != 0) continue;
      try {
        for (const fs::path& place : places_in(call)) places.note(place);
      } catch (const std::runtime_error& error) {
        unseen = error.what();
      }
      const seccomp_notif_resp answer{
          .id = call.id, .val = 0, .error = 0, .flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE};
      ::ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &answer);
    } else if (ends[0].revents != 0) {
      return receive(socket).words;
    }
  }
}

}  // namespace

WatchedWork watch_writes(const fs::path& allowed, const std::function<void()>& work) {
  Places places(allowed);
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets.data()) != 0) {
    throw std::system_error(errno, std::generic_category(), "socketpair");
  }
  const pid_t copy = ::fork();
  if (copy < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (copy == 0) {
    ::close(sockets[0]);
    be_the_copy(sockets[1], work);
  }
  ::close(sockets[1]);
  WatchedWork watched;
  const Message first = receive(sockets[0]);
  std::string last = first.words;
  if (first.descriptor >= 0) {
    last = attend(sockets[0], first.descriptor, places, watched.unseen);
    ::close(first.descriptor);
  }
  ::close(sockets[0]);
  int status = 0;
  while (::waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  const char how = last.empty() ? '\0' : last[0];
  if (how != '\0') last.erase(0, 1);
  if (how == kBadInput) throw InputError(last);
  if (how == kFailed) (first.descriptor < 0 ? watched.unseen : watched.failure) = last;
  if (how == '\0') {
    watched.failure = WIFSIGNALED(status)
                          ? fmt::format("it ended by signal {}", WTERMSIG(status))
                          : fmt::format("it ended with exit code {}", WEXITSTATUS(status));
  }
  watched.changes = places.changes();
  return watched;
}

}  // namespace fracbench::conformance
