#include "stored_results.h"

#include <chrono>
#include <thread>

#include "harness/data_file.h"
#include "harness/record.h"
#include "harness/record_store.h"
#include "tests/core/processes.h"

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

std::map<std::string, std::string> digests(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  const RecordStore store(folder);
  for (const std::filesystem::path& file : list_records(folder)) {
    const std::string key = file.stem().string();
    all[key] = result_digest(store.read(key));
  }
  return all;
}

void wait_for_records(const std::filesystem::path& folder, std::size_t count, ::pid_t child) {
  while (list_records(folder).size() < count && is_alive(child)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace fracbench
