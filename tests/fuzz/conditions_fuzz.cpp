// Published collision conditions in CSV, as the scenario family reads them.

#include "core/error.h"
#include "scenarios/families.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  const ScenarioFamily& family = find_family("published");
  try {
    const auto file = fuzz::scratch().write("conditions.csv", fuzz::text_of(data, size));
    family.scenes(Options(family.options(), {{"file", file.string()}}, "fuzz"), "squirrel", 1);
  } catch (const InputError&) {
  }
  return 0;
}
