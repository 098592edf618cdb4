#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "harness/plan.h"
#include "harness/record.h"
#include "metrics/metric.h"

namespace fracbench {

/// What a cell's record says of which cell it is.
CellIdentity identity_of(const Plan& plan, const Cell& cell);

/// The record of a cell that begins now: its identity, the notes of its shape, and `provenance`
/// with the name of the suite and the time of day added.
Record begin_record(const Plan& plan, const Cell& cell,
                    std::map<std::string, std::string> provenance);

/// Adds the metrics of the machine to a record whose times and peak memory are known.
void measure_cost(Record& record, const TriangleMesh& body,
                  std::span<const std::unique_ptr<Metric>> metrics);

/// Adds the values of `more` to those of `all`.
void append(Measurement& all, Measurement more);

}  // namespace fracbench
