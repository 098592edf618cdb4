#include "core/temporary_folder.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <string>
#include <system_error>

#include "core/error.h"

namespace fracbench {

namespace fs = std::filesystem;

TemporaryWorkFolder::TemporaryWorkFolder(std::string_view purpose) {
  std::string name =
      (fs::temp_directory_path() / fmt::format("fracbench-{}-XXXXXX", purpose)).string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw InputError(fmt::format("no folder can be made in '{}'; set TMPDIR",
                                 fs::temp_directory_path().string()));
  }
  path_ = name;
}

TemporaryWorkFolder::~TemporaryWorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace fracbench
