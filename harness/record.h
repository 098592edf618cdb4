#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/fragments.h"
#include "core/impact.h"
#include "core/trajectory.h"
#include "harness/cell_status.h"
#include "harness/cell_summary.h"
#include "harness/data_tree.h"
#include "scenarios/scene.h"

namespace fracbench {

/// Which cell a record is of: everything that its key was made from, in readable form.
struct CellIdentity {
  std::string method;
  std::string label;
  std::string method_options;  ///< JSON, defaults included
  std::string method_digest;   ///< of the sources that the method is built from
  std::string shape;           ///< label in the suite
  std::string shape_digest;    ///< of the mesh, which lies in shapes/<digest>.h5
  std::string family;
  std::string scenario;
  std::string scenario_values;  ///< JSON, see to_json(Scenario)
  int repeat = 0;
  std::uint64_t seed = 0;
  std::uint64_t prepare_seed = 0;
  int threads = 1;
  std::string source_digest;  ///< see BuildInfo
  bool operator==(const CellIdentity&) const = default;
};

/// What came out: the same bytes each time that the cell is measured.
struct CellOutcome {
  CellStatus status = CellStatus::ok;
  std::string reason;
  std::vector<std::string> notes;
  SceneResult scene;
  Measurement measurement;
};

/// What it took on this machine: different each time.
struct CellCost {
  std::vector<StageTime> stages;
  double total_seconds = 0;
  /// Making the breakable body, in this cell or in an earlier one that shares it, s.
  double prepare_seconds = 0;
  double peak_memory = 0;  ///< bytes
  Measurement measurement;
  std::map<std::string, std::string> provenance;
};

/// One cell, measured.
struct Record {
  std::string key;
  CellIdentity identity;
  CellOutcome outcome;
  CellCost cost;
};

/// The record as named arrays, in the layout of docs/records.md: "result/..." and "machine/...",
/// a digest of each, the key and the version of the layout. Where the target did not break, its
/// fragments (the target itself) are left out.
DataTree to_tree(const Record& record);

/// The other way round. Throws DataError where the tree is no record of this version, its digests
/// do not match, or its numbers contradict each other.
Record to_record(const DataTree& tree);

/// Throws DataError where the tree, which must be whole, is no record of this version or its
/// digests do not match.
void require_intact(const DataTree& tree);

/// SHA-256 over everything in "result/": equal for two runs of one cell.
std::string result_digest(const Record& record);

/// Whether summary_of needs an array, by path: all but meshes and trajectory.
bool is_summary_array(std::string_view path);

/// Whether compressing an array of a record saves more than it costs: the poses of bodies that fly
/// are like noise to a compressor (14 % saved, for half of the time of writing a record).
bool is_packed_array(std::string_view path);

/// From a tree that holds at least the arrays of is_summary_array. Digests are not verified: see
/// require_intact.
CellSummary to_summary(const DataTree& tree);
/// The same but for the digest, which stays empty: it takes as long as packing the record.
CellSummary to_summary(const Record& record);

}  // namespace fracbench
