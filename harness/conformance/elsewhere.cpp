#include "harness/conformance/elsewhere.h"

#include <cstdlib>

namespace fracbench::conformance {

namespace fs = std::filesystem;

Elsewhere::Elsewhere(const fs::path& folder) : before_(fs::current_path()) {
  for (std::size_t n = 0; n < kNames.size(); ++n) {
    if (const char* value = std::getenv(kNames[n])) values_[n] = value;
    fs::create_directories(folder / kNames[n]);
    ::setenv(kNames[n], (folder / kNames[n]).c_str(), 1);
  }
  fs::create_directories(folder / "current");
  fs::current_path(folder / "current");
}

Elsewhere::~Elsewhere() {
  std::error_code ignored;
  fs::current_path(before_, ignored);
  for (std::size_t n = 0; n < kNames.size(); ++n) {
    if (values_[n]) {
      ::setenv(kNames[n], values_[n]->c_str(), 1);
    } else {
      ::unsetenv(kNames[n]);
    }
  }
}

}  // namespace fracbench::conformance
