#include "harness/record_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/atomic_file.h"
#include "core/error.h"
#include "harness/data_file.h"
#include "harness/record_layout.h"
#include "harness/stored_suite.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = ".part";
constexpr std::size_t kKeyDigits = 64;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: the results folder cannot be made: {}; choose another one",
                                 folder.string(),
                                 error ? error.message() : "there is a file of this name"));
  }
}

/// Refuses a folder in which somebody keeps other things.
void require_results_folder(const fs::path& folder) {
  if (fs::exists(folder / "suite.json") || !fs::exists(folder)) return;
  for (const auto& item : fs::directory_iterator(folder)) {
    const std::string name = item.path().filename().string();
    // What the program itself puts there, `report` included.
    constexpr std::array kOwn = {"records",
                                 "claims",
                                 "shapes",
                                 "report",
                                 "learning",
                                 "learning.json",
                                 "suite.json.part",
                                 "summaries",
                                 "agreements",
                                 "study.data",
                                 "study.data.checkpoints"};
    if (std::ranges::find(kOwn, name) != kOwn.end()) continue;
    throw InputError(
        fmt::format("{}: holds '{}', which does not belong to a results folder; choose an empty or "
                    "new folder",
                    folder.string(), name));
  }
}

fs::path part_of(const fs::path& file) { return file.string() + std::string(kPart); }

}  // namespace

std::vector<fs::path> record_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& item : fs::directory_iterator(folder, error)) {
    const fs::path& file = item.path();
    if (file.extension() == ".h5" && file.stem().string().size() == kKeyDigits) {
      files.push_back(file);
    }
  }
  std::ranges::sort(files);
  return files;
}

std::vector<fs::path> list_records(const fs::path& folder) {
  return record_files(folder / "records");
}

namespace {

DataTree read_present(const fs::path& file) {
  if (!fs::exists(file)) throw DataError(fmt::format("{}: is missing", file.string()));
  return read_hdf5(file);
}

}  // namespace

Record read_record_file(const fs::path& file) {
  Record record = to_record(read_present(file));
  if (record.key != file.stem().string()) throw DataError("is the record of another cell");
  return record;
}

Record read_record(const fs::path& folder, std::string_view key) {
  return read_record_file(folder / "records" / fmt::format("{}.h5", key));
}

TriangleMesh read_target(const fs::path& folder, std::string_view digest) {
  TriangleMesh mesh =
      get_mesh(read_present(folder / "shapes" / fmt::format("{}.h5", digest)), "mesh");
  Digest sum;
  sum.add(mesh);
  if (sum.hex() != digest) throw DataError("the mesh is not the one that its file's name promises");
  return mesh;
}

RecordStore::RecordStore(fs::path folder) : folder_(std::move(folder)) {
  if (fs::exists(folder_) && !fs::is_directory(folder_)) make_folder(folder_);
  require_results_folder(folder_);
  for (const char* name : {"records", "claims", "shapes"}) make_folder(folder_ / name);
  remove_leftovers();
}

fs::path RecordStore::record_file(std::string_view key) const {
  return folder_ / "records" / fmt::format("{}.h5", key);
}

std::optional<Claim> RecordStore::claim(std::string_view key) const {
  return Claim::try_take(folder_ / "claims" / key);
}

Claim RecordStore::wait_for_claim(std::string_view name, const std::stop_token& stop) const {
  while (true) {
    if (stop.stop_requested()) throw Cancelled();
    if (auto taken = claim(name)) return std::move(*taken);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

bool RecordStore::contains(std::string_view key) const { return fs::exists(record_file(key)); }

Record RecordStore::read(std::string_view key) const { return read_record(folder_, key); }

CellSummary RecordStore::write(const Claim&, const Record& record) const {
  const fs::path file = record_file(record.key);
  const DataTree tree = to_tree(record);
  write_file_atomically(file, to_hdf5(tree, is_packed_array), part_of(file));
  CellSummary summary = to_summary(record);
  summary.result_digest = tree.text("result_digest");
  return summary;
}

fs::path RecordStore::set_aside(const Claim&, std::string_view key, std::string_view why) const {
  const fs::path file = record_file(key);
  const fs::path aside = fmt::format("{}.{}", file.string(), why);
  std::error_code error;
  fs::rename(file, aside, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot be renamed to {}: {}", file.string(),
                                 aside.filename().string(), error.message()));
  }
  return aside;
}

void RecordStore::write_shape(const std::string& digest, const TriangleMesh& mesh) const {
  const fs::path file = folder_ / "shapes" / (digest + ".h5");
  if (fs::exists(file)) return;
  const Claim claim = wait_for_claim("shape-" + digest);
  if (fs::exists(file)) return;
  DataTree tree;
  put_mesh(tree, "mesh", mesh);
  write_file_atomically(file, to_hdf5(tree), part_of(file));
}

TriangleMesh RecordStore::read_shape(const std::string& digest) const {
  return read_target(folder_, digest);
}

void RecordStore::bind_suite(const StoredSuite& suite) const {
  const Claim claim = wait_for_claim("suite");
  const fs::path file = folder_ / "suite.json";
  if (fs::exists(file)) {
    const std::vector<std::string> differences =
        differing_values(read_stored_suite(folder_), suite.values);
    if (!differences.empty()) throw InputError(describe_other_suite(folder_, differences));
    return;
  }
  write_file_atomically(file, stored_suite_text(suite), part_of(file));
}

void RecordStore::remove_leftovers() const {
  // A temporary is written only under its claim, so one that can be claimed has lost its writer.
  for (const auto& item : fs::directory_iterator(folder_ / "records")) {
    const fs::path& part = item.path();
    if (part.extension() != kPart) continue;
    const std::string key = part.stem().stem().string();
    std::error_code error;
    if (const auto taken = claim(key)) fs::remove(part, error);
  }
  // The same holds for claims; taking one and letting it go removes its file.
  for (const auto& item : fs::directory_iterator(folder_ / "claims")) {
    Claim::try_take(item.path());
  }
}

}  // namespace fracbench
