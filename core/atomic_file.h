#pragma once

#include <filesystem>
#include <string_view>

namespace fracbench {

/// Writes a file that appears whole or not at all: the bytes go to a temporary file in the same
/// folder, are synced to the disk, and take the final name in one step, replacing a file that has
/// it. Where the path names a device or pipe, the bytes go straight to it.
/// Throws InputError, with the system's reason, where that cannot be done; nothing is left behind.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace fracbench
