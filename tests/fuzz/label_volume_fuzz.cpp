// Label volumes, NRRD or HDF5 by content.

#include "core/error.h"
#include "geometry/read_label_volume.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  try {
    read_label_volume(fuzz::scratch().write("labels", fuzz::text_of(data, size)));
  } catch (const InputError&) {
  }
  return 0;
}
