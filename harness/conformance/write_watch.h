#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace fracbench::conformance {

/// What some work did to the disk, and how it ended.
struct WatchedWork {
  std::vector<std::string> changes;  ///< such as "leaves /tmp/x", in the order of the paths
  std::string failure;               ///< why it did not reach its end; empty: it did
  std::string unseen;  ///< why (some of) its writes could not be seen; empty: all were
};

/// Does the work in a copy of this process, and tells which files and folders outside `allowed`
/// exist, are gone or have changed after a system call that it made, or a thread or program that it
/// started; whatever is as it was before counts for nothing. Nothing is kept from the work: the
/// system asks this process before each such call and is told to go on (seccomp_unotify(2)), which
/// needs no rights. Where that cannot be had, the work is not done. Throws the InputError that the
/// work throws.
WatchedWork watch_writes(const std::filesystem::path& allowed, const std::function<void()>& work);

}  // namespace fracbench::conformance
