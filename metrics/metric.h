#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/fragments.h"
#include "core/impact.h"
#include "core/name.h"
#include "core/stage_timer.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// Everything that a cell metric may look at: one shape broken once.
struct CellResult {
  const TriangleMesh& body;         ///< the target before it broke
  const Fragments& fragments;       ///< what is left of it; the body itself where it did not break
  std::span<const Impact> impacts;  ///< in order of time; empty: it did not break
  std::span<const StageTime> stages;
  double total_seconds = 0;  ///< wall clock of the whole cell
  double peak_memory = 0;    ///< bytes
  int threads = 1;
};

/// One number, finite; a quantity that does not exist (the mean of nothing) is left out.
struct MetricValue {
  Name name;
  double value = 0;
  Name unit;  ///< empty: a pure number
};

/// Many numbers, such as the volume of each fragment.
struct MetricSeries {
  Name name;
  std::vector<double> values;
  Name unit;
};

struct Measurement {
  std::vector<MetricValue> values;
  std::vector<MetricSeries> series;
};

struct MetricInfo {
  std::string name;     ///< of the file pair and of the section in docs/metrics.md
  std::string summary;  ///< one line
  /// Depends on the machine (times, memory): kept apart from what must be the same bytes each time.
  bool of_machine = false;
};

/// Measures one cell. Stateless; adding one is a file pair and a line in registry.cpp.
class Metric {
 public:
  virtual ~Metric() = default;
  virtual MetricInfo info() const = 0;
  virtual Measurement measure(const CellResult& cell) const = 0;
};

}  // namespace fracbench
