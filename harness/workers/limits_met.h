#pragma once

#include <string_view>

#include "harness/record.h"
#include "harness/suite.h"

namespace fracbench {

/// Writes down under which limits a record was made, and which of them it met.
void note_limits(Record& record, const CellLimits& limits);
void note_limit_met(Record& record, std::string_view name);

/// Whether a record tells of a limit that was lower than the one in force now, so that the cell is
/// worth another try.
bool may_do_better(const Record& record, const CellLimits& limits);

}  // namespace fracbench
