#pragma once

#include <string>
#include <string_view>

#include "reports/table.h"

namespace fracbench {

/// What a comparison with a published value comes to.
enum class Verdict {
  match,           ///< the same in as many digits as were published, at most two
  within_ci,       ///< the published value lies in the interval of the measured one
  mismatch,        ///< neither
  not_comparable,  ///< not measured here, or not a quantity that other hardware shares
};
std::string_view to_string(Verdict verdict);

/// Of a measured number, or an estimate with its interval, beside a published one.
Verdict compare_with_published(double published, const TableCell& measured);

/// What a claim about the sign of a statistic comes to: "holds" where its whole interval is above
/// 0, "fails" where it is below, "open" where 0 lies in it or there is no interval,
/// "not-comparable" where it was not measured.
std::string_view judge_claim(const TableCell& statistic);

/// The rules above in one sentence each, for the reader of a report.
std::string verdict_rule();
std::string claim_rule();

}  // namespace fracbench
