#pragma once

#include <map>
#include <string>

namespace fracbench {

/// What made a record: program, revision, compiler, libraries, processor, system. Names to text.
std::map<std::string, std::string> collect_provenance();

/// The time of day in UTC, "2025-01-31T12:00:00Z".
std::string utc_now();

}  // namespace fracbench
