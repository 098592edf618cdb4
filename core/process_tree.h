#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace fracbench {

/// The children of a process, their children and so on, as far as the system tells; parents first.
std::vector<::pid_t> descendants(::pid_t process);

/// Resident memory of a process, bytes; 0 where there is none.
std::uint64_t resident_memory(::pid_t process);

/// From here on the end of the parent, or of that thread of it which started this process, is a
/// SIGTERM to it.
void end_with_parent();

}  // namespace fracbench
