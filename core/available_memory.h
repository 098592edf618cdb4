#pragma once

#include <cstdint>

namespace fracbench {

/// Bytes that this process can still take without swapping, as far as the system tells: the
/// smaller of what the machine has left and what the process's control group (a container's or
/// job's limit) has left. The largest number where the system tells nothing.
std::uint64_t available_memory();

}  // namespace fracbench
