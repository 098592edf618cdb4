#pragma once

#include "metrics/metric.h"

namespace fracbench {

/// `peak_memory`: the largest resident set of the process while it worked on the cell, bytes. It
/// holds everything in the process, the prepared method and the program itself included. Left out
/// where the system did not say.
class PeakMemory final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
