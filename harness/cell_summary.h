#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "core/name.h"
#include "core/stage_timer.h"
#include "harness/cell_status.h"
#include "metrics/metric.h"

namespace fracbench {

/// What reports need of one cell: everything in its record but the meshes and the trajectory.
struct CellSummary {
  std::string key;  ///< of the record, 64 hexadecimal digits
  /// SHA-256 of the record's result; empty where the summary does not come from a results folder.
  std::string result_digest = {};
  Name method;          ///< name in the registry
  Name label;           ///< name in the suite; the same as `method` unless the suite says otherwise
  Name method_options;  ///< JSON, defaults included
  Name shape;
  Name family;           ///< of the scenario
  std::string scenario;  ///< unique within its family
  int repeat = 0;
  std::uint64_t seed = 0;  ///< of the method; methods that meet the same impact differ in it

  CellStatus status = CellStatus::ok;
  std::string reason;  ///< why, where the status is neither ok nor unbroken

  std::vector<MetricValue> values;   ///< metrics of the result first, then those of the machine
  std::vector<MetricSeries> series;  ///< likewise
  std::vector<StageTime> stages;     ///< they add up to total_seconds within 2 %
  double total_seconds = 0;          ///< wall clock of the whole cell
  double prepare_seconds = 0;        ///< making the breakable body, in this cell or an earlier one
  double peak_memory = 0;            ///< of the process, bytes
  int threads = 1;                   ///< that the cell was allowed

  /// Magnitudes of the impact that broke the target (else of the strongest one that did not),
  /// strongest first, N s; empty where nothing touched it.
  std::vector<double> impulses;
  int breaks = 0;  ///< how many bodies broke, the target included
  Name cpu;
};

/// What all methods meet together: a shape, the family and name of a scene, and a repeat of it.
using Collision = std::tuple<std::string, std::string, std::string, int>;

inline Collision collision_of(const CellSummary& cell) {
  return {cell.shape, cell.family, cell.scenario, cell.repeat};
}

}  // namespace fracbench
