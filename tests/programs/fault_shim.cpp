// Preloaded into a program (LD_PRELOAD), makes one of its accesses to the disk fail, for tests:
//   FAULT_FOLDER  only files below this folder count
//   FAULT_AT      which call, from 1; 0: all of them
//   FAULT_KIND    full (ENOSPC), error (EIO), kill (SIGKILL instead of the call), kill-after,
//                 short (writes and reads do at most half of what they are asked for)
//   FAULT_COUNT   a file that is made to hold as many bytes as there were calls

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool is_below(const char* path) {
  const char* folder = std::getenv("FAULT_FOLDER");
  return folder && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_below(int descriptor) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = ::readlink(link, path, sizeof path - 1);
  if (length < 0) return false;
  path[length] = 0;
  return is_below(path);
}

bool is(const char* kind) {
  const char* wanted = std::getenv("FAULT_KIND");
  return wanted && std::strcmp(wanted, kind) == 0;
}

/// Whether this call is the one.
bool strikes() {
  static std::atomic<long> calls = 0;
  const long call = ++calls;
  if (const char* count = std::getenv("FAULT_COUNT")) ::truncate(count, call);
  const char* at = std::getenv("FAULT_AT");
  return at && std::atol(at) == call;
}

/// Calls, or fails instead.
template <typename Result, typename Call>
Result faulty(Call call) {
  if (!strikes()) return call();
  if (is("kill")) ::raise(SIGKILL);
  if (is("kill-after")) {
    call();
    ::raise(SIGKILL);
  }
  if (is("short")) return call();
  errno = is("full") ? ENOSPC : EIO;
  return -1;
}

std::size_t at_most(std::size_t count) { return is("short") && count > 1 ? count / 2 : count; }

}  // namespace

extern "C" ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  const auto call = real<decltype(write)>("write");
  if (!is_below(descriptor)) return call(descriptor, bytes, count);
  return faulty<ssize_t>([&] { return call(descriptor, bytes, at_most(count)); });
}

extern "C" ssize_t read(int descriptor, void* bytes, std::size_t count) {
  const auto call = real<decltype(read)>("read");
  return call(descriptor, bytes, is("short") && is_below(descriptor) ? at_most(count) : count);
}

extern "C" int fsync(int descriptor) {
  const auto call = real<decltype(fsync)>("fsync");
  if (!is_below(descriptor)) return call(descriptor);
  return faulty<int>([&] { return call(descriptor); });
}

extern "C" int rename(const char* from, const char* to) {
  const auto call = real<decltype(rename)>("rename");
  if (!is_below(to)) return call(from, to);
  return faulty<int>([&] { return call(from, to); });
}

extern "C" int mkdir(const char* path, mode_t mode) {
  const auto call = real<decltype(mkdir)>("mkdir");
  if (!is_below(path)) return call(path, mode);
  return faulty<int>([&] { return call(path, mode); });
}

extern "C" int unlink(const char* path) {
  const auto call = real<decltype(unlink)>("unlink");
  if (!is_below(path)) return call(path);
  return faulty<int>([&] { return call(path); });
}
