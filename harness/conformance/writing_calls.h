#pragma once

#include <linux/filter.h>
#include <linux/seccomp.h>

#include <filesystem>
#include <vector>

namespace fracbench::conformance {

/// Makes the system ask before each call by which this thread, the threads and the programs that it
/// starts could make, change or remove a file by its name, for good. The descriptor to listen at
/// (seccomp_unotify(2)), or -1 with errno.
int ask_before_writing();

/// The places that such a call names, absolute and without links among their folders, with those
/// that they lead to where they are links. Throws std::runtime_error with the reason where they
/// cannot be told.
std::vector<std::filesystem::path> places_in(const seccomp_notif& call);

}  // namespace fracbench::conformance
