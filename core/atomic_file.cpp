#include "core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>

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
  OpenFile(OpenFile&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)),
        remove_(std::exchange(other.remove_, {})) {}
  OpenFile& operator=(OpenFile&&) = delete;

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

using Parts = std::span<const std::string_view>;

std::size_t size_of(Parts parts) {
  std::size_t size = 0;
  for (const std::string_view part : parts) size += part.size();
  return size;
}

/// The file of these bytes that is to be renamed to `path`, not closed yet; none where that is a
/// device, which has the bytes then.
std::optional<OpenFile> written(const std::filesystem::path& path, Parts parts,
                                const std::filesystem::path& temporary) {
  const auto check = [&](int error) {
    if (error != 0) fail(path, size_of(parts), error);
  };
  const auto write = [&](const OpenFile& file) {
    for (const std::string_view part : parts) check(file.write(part));
  };
  struct ::stat status = {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    if (S_ISDIR(status.st_mode)) check(EISDIR);
    OpenFile device(path, O_WRONLY);
    if (!device.is_open()) check(errno);
    write(device);
    check(device.close());
    return std::nullopt;
  }
  OpenFile file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open()) check(errno);
  file.remove_at_end(temporary);
  write(file);
  return file;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// A name that nobody else uses.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  static std::atomic<unsigned> serial{0};
  return path.parent_path() / fmt::format(".fracbench-{}-{}.part", ::getpid(), serial++);
}

/// New names in a folder are safe once it is synced; some file systems cannot, and the files are
/// whole either way.
void sync_names(const std::filesystem::path& folder) {
  const OpenFile directory(folder, O_RDONLY | O_DIRECTORY);
  if (directory.is_open()) ::fsync(directory.descriptor());
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           std::filesystem::path temporary) {
  write_file_atomically(path, Parts(&bytes, 1), std::move(temporary));
}

void write_file_atomically(const std::filesystem::path& path, Parts parts,
                           std::filesystem::path temporary) {
  const std::size_t size = size_of(parts);
  if (temporary.empty()) temporary = temporary_beside(path);
  auto file = written(path, parts, temporary);
  if (!file) return;
  if (::fsync(file->descriptor()) != 0) fail(path, size, errno);
  if (const int error = file->close()) fail(path, size, error);
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, size, errno);
  file->keep();
  sync_names(folder_of(path));
}

AtomicFiles::~AtomicFiles() {
  for (const Added& file : added_) ::unlink(file.temporary.c_str());
}

void AtomicFiles::add(const std::filesystem::path& path, std::string_view bytes) {
  constexpr std::size_t many = 128;
  const std::filesystem::path temporary = temporary_beside(path);
  auto file = written(path, Parts(&bytes, 1), temporary);
  if (!file) return;
  if (const int error = file->close()) fail(path, bytes.size(), error);
  {
    const std::scoped_lock lock(mutex_);
    added_.push_back({path, temporary, bytes.size()});
    file->keep();
    if (added_.size() < many) return;
  }
  commit();
}

void AtomicFiles::commit() {
  AtomicFiles now;  // removes what is left of them where this throws
  {
    const std::scoped_lock lock(mutex_);
    now.added_.swap(added_);
  }
  std::set<std::filesystem::path> folders;
  for (const Added& file : now.added_) {
    if (!folders.insert(folder_of(file.path)).second) continue;
    const OpenFile directory(folder_of(file.path), O_RDONLY | O_DIRECTORY);
    if (!directory.is_open() || ::syncfs(directory.descriptor()) != 0) {
      fail(file.path, file.size, errno);
    }
  }
  std::ranges::reverse(now.added_);  // so that the first can be taken from the end
  while (!now.added_.empty()) {
    const Added& file = now.added_.back();
    if (::rename(file.temporary.c_str(), file.path.c_str()) != 0) {
      fail(file.path, file.size, errno);
    }
    now.added_.pop_back();
  }
  for (const std::filesystem::path& folder : folders) sync_names(folder);
}

}  // namespace fracbench
