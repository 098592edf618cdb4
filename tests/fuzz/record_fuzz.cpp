// Record files: HDF5 to a tree to a record, with and without its geometry.

#include "harness/data_file.h"
#include "harness/record.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  const auto file = fuzz::scratch().write("record.h5", fuzz::text_of(data, size));
  try {
    to_summary(read_hdf5(file, is_summary_array));
  } catch (const DataError&) {
  }
  try {
    to_record(read_hdf5(file));
  } catch (const DataError&) {
  }
  return 0;
}
