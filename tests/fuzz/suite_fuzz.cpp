// Suites in TOML.

#include "core/error.h"
#include "harness/suite_reader.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  static const Catalog catalog = built_in_catalog();
  try {
    parse_suite(fuzz::text_of(data, size), "suite.toml", catalog);
  } catch (const InputError&) {
  }
  return 0;
}
