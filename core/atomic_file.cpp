#include "core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.h"

namespace fracbench {

namespace {

std::string way_out(int error, const std::filesystem::path& folder) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return fmt::format("the folder '{}' must exist: create it first", folder.string());
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder in which you may write";
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another disk";
    case EISDIR:
      return "choose another name";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EFBIG:
      return "raise the limit on the size of files (ulimit -f)";
    default:
      return "choose another place";
  }
}

[[noreturn]] void fail(const std::filesystem::path& path, std::size_t size, int error) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  throw InputError(fmt::format("cannot write '{}' ({} bytes): {}; {}", path.string(), size,
                               std::generic_category().message(error), way_out(error, folder)));
}

/// An open file that is closed, and removed while it has a name to be removed, at the end.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& name, int flags)
      : descriptor_(::open(name.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!remove_.empty()) ::unlink(remove_.c_str());
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  void remove_at_end(const std::filesystem::path& name) { remove_ = name; }
  void keep() { remove_.clear(); }

  /// 0 or the error's number.
  int write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ::ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return count < 0 ? errno : EIO;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
  }
  int close() {
    const int result = ::close(descriptor_);
    descriptor_ = -1;
    return result == 0 ? 0 : errno;
  }

 private:
  int descriptor_;
  std::filesystem::path remove_;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           std::filesystem::path temporary) {
  const auto check = [&](int error) {
    if (error != 0) fail(path, bytes.size(), error);
  };
  struct ::stat status = {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    if (S_ISDIR(status.st_mode)) check(EISDIR);
    OpenFile device(path, O_WRONLY);
    if (!device.is_open()) check(errno);
    check(device.write(bytes));
    check(device.close());
    return;
  }

  static std::atomic<unsigned> serial{0};
  if (temporary.empty()) {
    temporary = path.parent_path() / fmt::format(".fracbench-{}-{}.part", ::getpid(), serial++);
  }
  OpenFile file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open()) check(errno);
  file.remove_at_end(temporary);
  check(file.write(bytes));
  if (::fsync(file.descriptor()) != 0) check(errno);
  check(file.close());
  if (::rename(temporary.c_str(), path.c_str()) != 0) check(errno);
  file.keep();

  // The new name itself is safe once the folder is synced; some file systems cannot, and the file
  // is whole either way.
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const OpenFile directory(folder, O_RDONLY | O_DIRECTORY);
  if (directory.is_open()) ::fsync(directory.descriptor());
}

}  // namespace fracbench
