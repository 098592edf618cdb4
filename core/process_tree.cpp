#include "core/process_tree.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

namespace fracbench {

namespace {

namespace fs = std::filesystem;

// A process that forks without end must not make this endless.
constexpr std::size_t kMaximumProcesses = 4096;

void add_children(::pid_t process, std::vector<::pid_t>& found) {
  std::error_code error;
  fs::directory_iterator thread("/proc/" + std::to_string(process) + "/task", error);
  for (; !error && thread != fs::directory_iterator(); thread.increment(error)) {
    std::ifstream children(thread->path() / "children");
    for (::pid_t child = 0; found.size() < kMaximumProcesses && children >> child;) {
      found.push_back(child);
    }
  }
}

}  // namespace

std::vector<::pid_t> descendants(::pid_t process) {
  std::vector<::pid_t> found;
  add_children(process, found);
  for (std::size_t i = 0; i < found.size(); ++i) add_children(found[i], found);
  return found;
}

std::uint64_t resident_memory(::pid_t process) {
  static const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  std::ifstream statm("/proc/" + std::to_string(process) + "/statm");
  std::uint64_t total = 0, resident = 0;
  if (!(statm >> total >> resident)) return 0;
  return resident * page;
}

void end_with_parent() { ::prctl(PR_SET_PDEATHSIG, SIGTERM); }

}  // namespace fracbench
