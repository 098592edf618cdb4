#include "metrics/peak_memory.h"

#include "metrics/measurement.h"

namespace fracbench {

MetricInfo PeakMemory::info() const {
  return {.name = "peak_memory",
          .summary = "largest resident set of the process during the cell",
          .of_machine = true};
}

Measurement PeakMemory::measure(const CellResult& cell) const {
  Measurement result;
  if (cell.peak_memory > 0) add_value(result, "peak_memory", cell.peak_memory, "B");
  return result;
}

}  // namespace fracbench
