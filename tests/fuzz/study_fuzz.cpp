// Files of studies. They end with a check sum of what comes before: the input is a file without
// it, so that what is made of the arrays is reached, too.

#include "core/digest.h"
#include "core/error.h"
#include "neural/representation_study.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  const std::string_view text = fuzz::text_of(data, size);
  try {
    const auto file = fuzz::scratch().write("study", fuzz::with_digest(text));
    neural::read_representation_study(file);
  } catch (const InputError&) {
  }
  return 0;
}
