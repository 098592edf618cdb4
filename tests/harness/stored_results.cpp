#include "stored_results.h"

#include "harness/data_file.h"
#include "harness/record.h"
#include "harness/record_store.h"

namespace fracbench {

std::map<std::string, DataTree::Array> stored_results(const std::filesystem::path& folder) {
  std::map<std::string, DataTree::Array> all;
  if (!std::filesystem::exists(folder / "records")) return all;
  for (const std::filesystem::path& file : list_records(folder)) {
    const DataTree tree = read_hdf5(file);
    to_record(tree);  // throws where the digests do not match
    for (const auto& [path, array] : tree.arrays()) {
      if (path.starts_with("result")) all[file.filename().string() + ":" + path] = array;
    }
  }
  return all;
}

}  // namespace fracbench
