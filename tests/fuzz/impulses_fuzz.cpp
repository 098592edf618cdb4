// impulses.json of a folder of fragments that some tool has made.

#include "core/collision_folder.h"
#include "core/error.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  static const auto folder = [] {
    const auto made = fuzz::scratch().path() / "imported";
    std::filesystem::create_directories(made / "a");
    return made;
  }();
  try {
    fuzz::scratch().write("imported/a/impulses.json", fuzz::text_of(data, size));
    read_collision_folder(folder);
  } catch (const InputError&) {
  }
  return 0;
}
