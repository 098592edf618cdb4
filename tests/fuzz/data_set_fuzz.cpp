// Data set files. They end with a check sum of what comes before: the input is a file without it,
// so that what is made of the arrays is reached, too.

#include "core/digest.h"
#include "core/error.h"
#include "neural/data_set.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  const std::string_view text = fuzz::text_of(data, size);
  try {
    const auto file = fuzz::scratch().write("data_set", fuzz::with_digest(text));
    neural::read_data_set(file);
  } catch (const InputError&) {
  }
  return 0;
}
