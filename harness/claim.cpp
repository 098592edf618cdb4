#include "harness/claim.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.h"

namespace fracbench {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int descriptor, std::string_view what) {
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  throw InputError(fmt::format("{}: cannot {} this file: {}; choose another results folder",
                               file.string(), what, std::generic_category().message(error)));
}

/// Whether the open file still has that name.
bool is_same_file(int descriptor, const std::filesystem::path& file) {
  struct ::stat opened = {};
  struct ::stat named = {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

std::optional<Claim> Claim::try_take(const std::filesystem::path& file) {
  while (true) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(file, descriptor, "create");
    int result = ::flock(descriptor, LOCK_EX | LOCK_NB);
    while (result != 0 && errno == EINTR) result = ::flock(descriptor, LOCK_EX | LOCK_NB);
    if (result != 0 && errno == EWOULDBLOCK) {
      ::close(descriptor);
      return std::nullopt;
    }
    if (result != 0) fail(file, descriptor, "lock");
    // Its last holder may have removed the file between our opening and our locking it.
    if (is_same_file(descriptor, file)) return Claim(file, descriptor);
    ::close(descriptor);
  }
}

Claim::~Claim() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());  // while it is still locked: afterwards it may be another's
  ::close(descriptor_);
}

}  // namespace fracbench
