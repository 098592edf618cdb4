#pragma once

#include <string>

namespace fracbench {

/// Puts the right checksum into the superblock (version 2) at the start of a file's bytes. HDF5
/// clears the "open for writing" flag in the images that it gives of files in memory and leaves the
/// checksum as it was, so that it would not open them again. ("HDF5 File Format Specification
/// Version 3.0", section II.A; the hash is lookup3 of Bob Jenkins, 2006.)
void renew_superblock_checksum(std::string& file);

}  // namespace fracbench
