#pragma once

#include <string>

namespace fracbench {

/// What the program was built from; made anew at each build (cmake/build_info.cmake).
struct BuildInfo {
  std::string version;   ///< of the project
  std::string revision;  ///< of the repository; "unknown" outside one
  bool dirty = false;    ///< there were changes that are in no revision
  /// SHA-256 over the sources that every result depends on, whatever the method: core, geometry,
  /// scenarios and metrics. Part of every key.
  std::string source_digest;
  std::string compiler;
  std::string build_type;
};

const BuildInfo& build_info();

}  // namespace fracbench
