#include "harness/conformance/writing_calls.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fracbench::conformance {

namespace {

namespace fs = std::filesystem;

#if defined(__x86_64__)
constexpr unsigned kProcessor = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kProcessor = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned kProcessor = 0;
#endif

constexpr int kCurrent = -1, kNone = -1;

/// Numbers of arguments: a name, and the open folder that it is relative to.
struct Name {
  int folder = kCurrent;
  int path = kNone;
};

struct WritingCall {
  unsigned number;
  std::array<Name, 2> names;
  int flags = kNone;  ///< the argument that says whether an opened file can be written
};

constexpr WritingCall kCalls[] = {
#ifdef SYS_open  // newer processors have only those with a folder
    {SYS_open, {{{kCurrent, 0}}}, 1},
    {SYS_creat, {{{kCurrent, 0}}}},
    {SYS_mkdir, {{{kCurrent, 0}}}},
    {SYS_mknod, {{{kCurrent, 0}}}},
    {SYS_rmdir, {{{kCurrent, 0}}}},
    {SYS_unlink, {{{kCurrent, 0}}}},
    {SYS_rename, {{{kCurrent, 0}, {kCurrent, 1}}}},
    {SYS_link, {{{kCurrent, 1}}}},
    {SYS_symlink, {{{kCurrent, 1}}}},
#endif
#ifdef SYS_renameat
    {SYS_renameat, {{{0, 1}, {2, 3}}}},
#endif
    {SYS_openat, {{{0, 1}}}, 2},
    {SYS_openat2, {{{0, 1}}}},
    {SYS_truncate, {{{kCurrent, 0}}}},
    {SYS_mkdirat, {{{0, 1}}}},
    {SYS_mknodat, {{{0, 1}}}},
    {SYS_unlinkat, {{{0, 1}}}},
    {SYS_renameat2, {{{0, 1}, {2, 3}}}},
    {SYS_linkat, {{{2, 3}}}},
    {SYS_symlinkat, {{{1, 2}}}},
};

/// A program for the kernel, which it runs at each system call.
std::vector<sock_filter> filter() {
  const auto load = [](std::size_t offset) -> sock_filter {
    return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
  };
  const auto answer = [](unsigned action) -> sock_filter {
    return BPF_STMT(BPF_RET | BPF_K, action);
  };
  const auto unless_equal = [](unsigned value, unsigned char skip) -> sock_filter {
    return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, skip);
  };
  std::vector<sock_filter> code = {
      load(offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kProcessor, 1, 0),
      answer(SECCOMP_RET_USER_NOTIF),
      load(offsetof(seccomp_data, nr)),
      // A queue through which files could be opened unseen; who asks for it can do without.
      unless_equal(SYS_io_uring_setup, 1),
      answer(SECCOMP_RET_ERRNO | ENOSYS),
  };
  for (const WritingCall& call : kCalls) {
    if (call.flags == kNone) {
      code.insert(code.end(), {unless_equal(call.number, 1), answer(SECCOMP_RET_USER_NOTIF)});
      continue;
    }
    constexpr unsigned writes = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
    code.insert(code.end(),
                {unless_equal(call.number, 4),
                 load(offsetof(seccomp_data, args) + sizeof(std::uint64_t) * call.flags),
                 BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, writes, 0, 1), answer(SECCOMP_RET_USER_NOTIF),
                 answer(SECCOMP_RET_ALLOW)});
  }
  code.push_back(answer(SECCOMP_RET_ALLOW));
  return code;
}

/// The text at an address of another process; nothing where none is, which its call will find, too.
std::optional<std::string> text_at(unsigned process, std::uint64_t address) {
  const int memory = ::open(fmt::format("/proc/{}/mem", process).c_str(), O_RDONLY | O_CLOEXEC);
  if (memory < 0 && (errno == EACCES || errno == EPERM)) {
    throw std::runtime_error("it starts programs that do not let themselves be read");
  }
  std::array<char, PATH_MAX> buffer;
  const ssize_t count = ::pread(memory, buffer.data(), buffer.size(), static_cast<off_t>(address));
  ::close(memory);
  const std::string_view text(buffer.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  std::size_t end = text.find('\0');
  if (end == std::string_view::npos) return std::nullopt;
  while (end > 1 && text[end - 1] == '/') --end;
  return std::string(text.substr(0, end));
}

/// Absolute, for a name that the process gives relative to a folder which it has opened; empty
/// where there is no such folder, which the call will find, too.
fs::path absolute(unsigned process, int folder, const fs::path& name) {
  if (name.is_absolute()) return name;
  std::error_code error;
  const fs::path base =
      fs::read_symlink(folder == AT_FDCWD ? fmt::format("/proc/{}/cwd", process)
                                          : fmt::format("/proc/{}/fd/{}", process, folder),
                       error);
  return error ? fs::path() : base / name;
}

/// The place of a name, and where that is a link, what it leads to, step by step.
std::vector<fs::path> followed(fs::path name) {
  constexpr std::size_t most = 40;  // as the system has it
  std::vector<fs::path> places;
  while (!name.empty() && places.size() < most) {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(name.parent_path(), error);
    // A process's links to what it has opened mean another one when they are read from here.
    if (error || folder.string().starts_with("/proc/")) break;
    places.push_back(folder / name.filename());
    const fs::path target = fs::read_symlink(places.back(), error);
    name = error ? fs::path() : folder / target;
  }
  return places;
}

}  // namespace

int ask_before_writing() {
  if (kProcessor == 0) {
    errno = ENOSYS;
    return -1;
  }
  std::vector<sock_filter> code = filter();
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return -1;
  // The second flag changes nothing here, but is unknown to kernels before 5.7, some of which
  // cannot be told to go on with a call.
  return static_cast<int>(
      ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER,
                SECCOMP_FILTER_FLAG_NEW_LISTENER | SECCOMP_FILTER_FLAG_TSYNC_ESRCH, &program));
}

std::vector<fs::path> places_in(const seccomp_notif& call) {
  if (call.data.arch != kProcessor) {
    throw std::runtime_error("it starts programs for another processor");
  }
  std::vector<fs::path> all;
  for (const WritingCall& known : kCalls) {
    if (known.number != static_cast<unsigned>(call.data.nr)) continue;
    for (const Name& name : known.names) {
      if (name.path == kNone) continue;
      const auto text = text_at(call.pid, call.data.args[name.path]);
      if (!text || text->empty()) continue;
      const int folder =
          name.folder == kCurrent ? AT_FDCWD : static_cast<int>(call.data.args[name.folder]);
      const std::vector<fs::path> places = followed(absolute(call.pid, folder, *text));
      all.insert(all.end(), places.begin(), places.end());
    }
  }
  return all;
}

}  // namespace fracbench::conformance
