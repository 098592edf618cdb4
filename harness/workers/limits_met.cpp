#include "harness/workers/limits_met.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <optional>
#include <string>

namespace fracbench {

namespace {

constexpr const char* kMet = "limit_met";

std::string entry_of(std::string_view limit) { return fmt::format("limit_{}", limit); }

std::map<std::string, double, std::less<>> by_name(const CellLimits& limits) {
  return {{"timeout_s", limits.timeout_s},
          {"prepare_timeout_s", limits.prepare_timeout_s},
          {"memory_mb", limits.memory_mb}};
}

std::optional<double> number_from(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void note_limits(Record& record, const CellLimits& limits) {
  for (const auto& [name, value] : by_name(limits)) {
    record.cost.provenance[entry_of(name)] = fmt::format("{}", value);
  }
}

void note_limit_met(Record& record, std::string_view name) { record.cost.provenance[kMet] = name; }

bool may_do_better(const Record& record, const CellLimits& limits) {
  const auto& provenance = record.cost.provenance;
  const auto met = provenance.find(kMet);
  if (met == provenance.end()) return false;
  const auto before = provenance.find(entry_of(met->second));
  const auto limit_now = by_name(limits);
  const auto now = limit_now.find(met->second);
  if (before == provenance.end() || now == limit_now.end()) return false;
  const auto value = number_from(before->second);
  if (!value || *value == 0) return false;  // it was the machine's limit
  return now->second == 0 || now->second > *value;
}

}  // namespace fracbench
