// Scenes in TOML.

#include "core/error.h"
#include "scenarios/scenario_toml.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  try {
    read_scenario(fuzz::scratch().write("scene.toml", fuzz::text_of(data, size)));
  } catch (const InputError&) {
  }
  return 0;
}
