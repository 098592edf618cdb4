// learning.json of a folder of learning data.

#include "core/error.h"
#include "harness/learning_index.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  try {
    const auto file = fuzz::scratch().write("learning.json", fuzz::text_of(data, size));
    read_learning_index(file.parent_path());
  } catch (const InputError&) {
  }
  return 0;
}
