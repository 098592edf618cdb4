#pragma once

namespace fracbench {

/// From here on this process keeps what it frees, up to 64 MB and but for blocks of 32 MB or more,
/// for what it allocates next: the bounds that glibc itself adapts to once it has freed such a
/// block. Where the same blocks are taken and freed again and again, as when records are read and
/// written, the system would otherwise clear each page for them every time, which costs more than
/// the work itself. No effect where the C library is not glibc.
void keep_freed_memory();

/// The same without bounds, for one that works in blocks of any size until it ends.
void keep_all_freed_memory();

}  // namespace fracbench
