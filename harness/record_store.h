#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "harness/claim.h"
#include "harness/record.h"
#include "harness/stored_suite.h"

namespace fracbench {

/// The files of records that lie directly in a folder, sorted; only looks.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& folder);

/// The record in a file that is called after its key, verified; only looks. Throws DataError where
/// it is missing or damaged, or is the record of another key.
Record read_record_file(const std::filesystem::path& file);

/// The records of a results folder, sorted; only looks.
std::vector<std::filesystem::path> list_records(const std::filesystem::path& folder);

/// The record of a key in a results folder, verified; only looks. Throws DataError where it is
/// missing or damaged, or is not the record of this key.
Record read_record(const std::filesystem::path& folder, std::string_view key);

/// The mesh of a target in a results folder; only looks. Throws DataError where it is missing or
/// damaged.
TriangleMesh read_target(const std::filesystem::path& folder, std::string_view digest);

/// A results folder:
///   suite.json            the suite that it belongs to
///   records/<key>.h5      one file per cell, whole or not there
///   shapes/<digest>.h5    the meshes of the targets
///   claims/               which cells somebody is working on
///   summaries/            what the records say, for whoever needs no more (SummaryCache)
///   study.data            what its study found, where it has one (harness/study.h); beside it
///                         study.data.checkpoints/, until it is done
///   agreements/           how well fractures agree with the reference (AgreementCache)
/// Any number of threads, processes and machines may use it at the same time.
class RecordStore {
 public:
  /// Makes the folder where it is not there, and removes what killed processes left in it. Throws
  /// InputError where it cannot be made or written, or holds other things than results.
  explicit RecordStore(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path record_file(std::string_view key) const;

  /// The right to make the record of a key; none while another holds it.
  std::optional<Claim> claim(std::string_view key) const;

  /// The same, waited for. Throws Cancelled when asked to stop.
  Claim wait_for_claim(std::string_view name, const std::stop_token& stop = {}) const;

  /// Whether there is a file for this key; says nothing of what is in it.
  bool contains(std::string_view key) const;

  /// The record of a key, verified. Throws DataError where it is missing or damaged, or is not the
  /// record of this key.
  Record read(std::string_view key) const;

  /// Writes the record; it is on the disk when this returns. Returns its summary. Throws InputError
  /// where it cannot be written (disk full), and leaves nothing behind. For the holder of the key's
  /// claim.
  CellSummary write(const Claim& claim, const Record& record) const;

  /// Renames a record that cannot be used, so that the cell is measured again and nothing is lost:
  /// "<key>.h5.<why>". Returns the new name. For the holder of the key's claim.
  std::filesystem::path set_aside(const Claim& claim, std::string_view key,
                                  std::string_view why) const;

  /// Keeps a target's mesh, once.
  void write_shape(const std::string& digest, const TriangleMesh& mesh) const;
  /// Throws DataError where it is missing or damaged.
  TriangleMesh read_shape(const std::string& digest) const;

  /// Makes the folder that of a suite. Throws InputError, naming the values that differ, where it
  /// belongs to another one.
  void bind_suite(const StoredSuite& suite) const;

 private:
  void remove_leftovers() const;

  std::filesystem::path folder_;
};

}  // namespace fracbench
