#pragma once

#include <filesystem>
#include <string_view>

namespace fracbench {

/// Writes a file that appears whole or not at all: the bytes go to a temporary file in the same
/// folder, are synced to the disk, and take the final name in one step, replacing a file that has
/// it. Where the path names a device or pipe, the bytes go straight to it.
/// Throws InputError, with the system's reason, where that cannot be done; nothing is left behind.
/// `temporary` is the name of the temporary file, for callers who know that nobody else uses it
/// and clean up after a process that was killed; by default it is one of this process's own.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           std::filesystem::path temporary = {});

}  // namespace fracbench
