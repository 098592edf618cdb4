// A summary of results, as it is committed as a baseline.

#include "core/error.h"
#include "harness/summary_file.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  try {
    read_summary_file(fuzz::scratch().write("summary.json", fuzz::text_of(data, size)));
  } catch (const InputError&) {
  }
  return 0;
}
