#pragma once

#include <cstdint>

namespace fracbench {

/// Starts a new measurement of this process's peak memory, where the system allows it.
void reset_peak_memory();

/// Largest resident set of this process since the last reset (else since it started), bytes.
std::uint64_t peak_memory();

}  // namespace fracbench
