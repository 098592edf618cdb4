#include "reports/verdict.h"

#include <cmath>
#include <optional>

namespace fracbench {

namespace {

std::optional<Estimate> estimate_in(const TableCell& cell) {
  if (const auto* e = std::get_if<Estimate>(&cell)) return *e;
  if (const auto* value = std::get_if<double>(&cell)) return Estimate{*value, *value, *value};
  return std::nullopt;
}

/// Rounded to two significant digits.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 1);
  return std::round(value / unit) * unit;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::match:
      return "match";
    case Verdict::within_ci:
      return "within-ci";
    case Verdict::mismatch:
      return "mismatch";
    case Verdict::not_comparable:
      break;
  }
  return "not-comparable";
}

Verdict compare_with_published(double published, const TableCell& measured) {
  const auto estimate = estimate_in(measured);
  if (!estimate) return Verdict::not_comparable;
  const double a = rounded(estimate->value);
  const double b = rounded(published);
  if (std::abs(a - b) <= 1e-9 * std::abs(b)) return Verdict::match;
  if (estimate->low <= published && published <= estimate->high) return Verdict::within_ci;
  return Verdict::mismatch;
}

std::string_view judge_claim(const TableCell& statistic) {
  if (std::holds_alternative<std::monostate>(statistic)) return "not-comparable";
  const auto* estimate = std::get_if<Estimate>(&statistic);
  if (!estimate) return "open";
  if (estimate->low > 0) return "holds";
  if (estimate->high < 0) return "fails";
  return "open";
}

std::string verdict_rule() {
  return "match: the same when rounded to two digits; within-ci: the published value lies in the "
         "interval of the measured one; mismatch: neither; not-comparable: not measured here, or "
         "a time on other hardware.";
}

std::string claim_rule() {
  return "holds: the whole interval is above 0; fails: all of it is below; open: 0 lies in it, or "
         "there are too few collisions for an interval; not-comparable: not measured here.";
}

}  // namespace fracbench
