#include "core/temporary_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#include <string>
#include <system_error>

#include "core/error.h"

namespace fracbench {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "fracbench-work-";
constexpr std::time_t kSecondsToLock = 60;  // a younger folder may be about to be locked

int open_folder(const fs::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

bool lock(int folder) { return ::flock(folder, LOCK_EX | LOCK_NB) == 0; }

bool is_abandoned(int folder) {
  struct stat status {};
  return ::fstat(folder, &status) == 0 && status.st_uid == ::geteuid() &&
         status.st_mtime + kSecondsToLock < std::time(nullptr) && lock(folder);
}

}  // namespace

TemporaryWorkFolder::TemporaryWorkFolder(std::string_view purpose) {
  std::string name =
      (fs::temp_directory_path() / fmt::format("{}{}-XXXXXX", kPrefix, purpose)).string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw InputError(fmt::format("no folder can be made in '{}'; set TMPDIR",
                                 fs::temp_directory_path().string()));
  }
  path_ = name;
  lock_ = open_folder(path_);
  lock(lock_);
}

TemporaryWorkFolder::~TemporaryWorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  ::close(lock_);
}

void remove_abandoned_work_folders() {
  std::error_code error;
  for (auto at = fs::directory_iterator(fs::temp_directory_path(error), error);
       !error && at != fs::directory_iterator(); at.increment(error)) {
    if (!at->path().filename().string().starts_with(kPrefix)) continue;
    const int folder = open_folder(at->path());
    if (folder < 0) continue;
    std::error_code ignored;
    if (is_abandoned(folder)) fs::remove_all(at->path(), ignored);
    ::close(folder);
  }
}

}  // namespace fracbench
