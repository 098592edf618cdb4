#include "harness/build_info.h"

#include <fmt/format.h>

#include "build_info_values.h"

namespace fracbench {

const BuildInfo& build_info() {
  static const BuildInfo info = {
      .version = FRACBENCH_VERSION,
      .revision = FRACBENCH_REVISION,
      .dirty = FRACBENCH_DIRTY != 0,
      .source_digest = FRACBENCH_SOURCE_DIGEST,
#ifdef __clang__
      .compiler = fmt::format("Clang {}", __clang_version__),
#else
      .compiler = fmt::format("GCC {}", __VERSION__),
#endif
      .build_type = FRACBENCH_BUILD_TYPE,
  };
  return info;
}

}  // namespace fracbench
