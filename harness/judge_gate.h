#pragma once

#include <vector>

#include "harness/compare.h"

namespace fracbench {

/// Measures the change that a gate asks about on the cells of one method, with noise, the smallest
/// change found, and the p-value. The outcome is `pass` where it is still to be judged; p-values
/// are corrected, and outcomes decided, by decide(). `tests` is how many gates are judged in all.
GateResult measure_gate(const Gate& gate, const std::string& method,
                        const std::vector<CellPair>& pairs, std::size_t tests);

/// Corrects the p-values of the gates that can be judged, and says which of them are regressions.
void decide(std::vector<GateResult>& results);

}  // namespace fracbench
