#include "reports/items/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/error.h"
#include "metrics/distribution_distance.h"
#include "metrics/summary.h"
#include "reports/published.h"
#include "reports/shape_volumes.h"
#include "reports/verdict.h"

namespace fracbench {

namespace {

constexpr std::string_view kReference = "bem";
constexpr std::string_view kAnotherImpact = "bem, another impact";

using Cells = std::vector<CellRef>;

/// What a claim is evaluated on: the cells of one shape that broke it.
class Evidence {
 public:
  Evidence(const ShapeVolumes& shape, const ReportInput& input) : shape_(shape), input_(input) {
    for (const ReferenceAgreement& a : input.agreements) {
      if (a.shape != shape.shape) continue;
      const std::string label = a.other_impact ? std::string(kAnotherImpact) : a.label;
      agreement_[{label, a.family, a.scenario, a.repeat}] = a.agreement.partition.adjusted_rand;
    }
  }

  /// Whether anything is known of that label.
  bool has(const std::string& label) const {
    return std::ranges::any_of(shape_.methods, [&](const auto& m) { return m.label == label; });
  }

  TableCell evaluate(const Claim& claim, const std::string& other) const {
    Cells pooled;
    for (const CellGroup& group : shape_.methods) {
      if (group.label == claim.subject || group.label == other || group.label == kReference) {
        pooled.insert(pooled.end(), group.cells.begin(), group.cells.end());
      }
    }
    const auto statistic = [&](std::span<const CellRef> cells) {
      return value(claim, other, cells);
    };
    return estimate(pooled, statistic, input_,
                    fmt::format("{} {} {}", shape_.shape, claim.name, other));
  }

 private:
  static Cells of(std::span<const CellRef> cells, std::string_view label) {
    Cells result;
    for (const CellSummary& cell : cells) {
      if (cell.label == label) result.emplace_back(cell);
    }
    return result;
  }

  std::optional<double> value(const Claim& claim, const std::string& other,
                              std::span<const CellRef> cells) const {
    if (claim.statistic == "volume-distance") {
      return difference(volume_distance(cells, other), volume_distance(cells, claim.subject));
    }
    if (claim.statistic == "agreement") {
      return difference(agreement(cells, claim.subject), agreement(cells, other));
    }
    const auto mean = [&](std::string_view label) { return mean_of(claim.metric, cells, label); };
    if (claim.statistic == "mean-difference") return difference(mean(claim.subject), mean(other));
    if (claim.statistic == "mean-distance") {
      const auto off = [&](std::string_view label) -> std::optional<double> {
        const auto d = difference(mean(label), mean(kReference));
        return d ? std::optional(std::abs(*d)) : std::nullopt;
      };
      return difference(off(other), off(claim.subject));
    }
    throw InputError(fmt::format("published claim '{}': there is no statistic '{}'", claim.name,
                                 claim.statistic));
  }

  static std::optional<double> difference(std::optional<double> a, std::optional<double> b) {
    return a && b ? std::optional(*a - *b) : std::nullopt;
  }

  static std::optional<double> mean_of(const std::string& metric, std::span<const CellRef> cells,
                                       std::string_view label) {
    const std::vector<double> values = values_of(of(cells, label), metric);
    return values.empty() ? std::nullopt : std::optional(summarize(values).mean);
  }

  /// Of the fragment volumes of a method to those of the reference.
  std::optional<double> volume_distance(std::span<const CellRef> cells,
                                        std::string_view label) const {
    const std::vector<double> a = volumes_above(of(cells, label), shape_.cut);
    const std::vector<double> b = volumes_above(of(cells, kReference), shape_.cut);
    if (a.empty() || b.empty()) return std::nullopt;
    return wasserstein(a, b);
  }

  std::optional<double> agreement(std::span<const CellRef> cells, const std::string& label) const {
    const bool floor = label == kAnotherImpact;
    std::vector<double> values;
    for (const CellSummary& cell : cells) {
      if (cell.label != (floor ? kReference : std::string_view(label))) continue;
      const auto found = agreement_.find({label, cell.family, cell.scenario, cell.repeat});
      if (found != agreement_.end()) values.push_back(found->second);
    }
    return values.empty() ? std::nullopt : std::optional(summarize(values).mean);
  }

  const ShapeVolumes& shape_;
  const ReportInput& input_;
  std::map<std::tuple<std::string, std::string, std::string, int>, double> agreement_;
};

/// With whom the subject of a claim is compared: those of the claim, then the baselines that there
/// are, and the reference under other labels (another seed or grid), which is the ceiling.
std::vector<std::string> opponents(const Claim& claim, const Claims& claims,
                                   const ShapeVolumes& shape, const Evidence& evidence) {
  std::vector<std::string> result = claim.others;
  if (claim.statistic == "mean-difference") return result;
  const auto add = [&](const std::string& label) {
    if (label != claim.subject && std::ranges::find(result, label) == result.end()) {
      result.push_back(label);
    }
  };
  for (const std::string& label : claims.baselines) {
    const bool floor = label == kAnotherImpact;
    if (floor ? claim.statistic == "agreement" && evidence.has(std::string(kReference))
              : evidence.has(label)) {
      add(label);
    }
  }
  for (const CellGroup& group : shape.methods) {
    if (group.label != kReference && group.cells.front().get().method == kReference) {
      add(group.label);
    }
  }
  return result;
}

}  // namespace

ReportItemInfo ClaimsTable::info() const {
  return {.name = "claims", .title = "What the paper says"};
}

ReportSection ClaimsTable::render(const ReportInput& input) const {
  const Claims claims = published_claims();
  Table table{.name = "claims",
              .title = "Claims of the paper",
              .notes = {"Positive is what is claimed; " + claim_rule(),
                        "Beside the methods that the paper names, a baseline or bem itself with "
                        "another grid or seed: against those nothing is claimed."},
              .columns = {{"claim"},
                          {"shape"},
                          {"method"},
                          {"beside"},
                          {"claimed"},
                          {"statistic"},
                          {"value"},
                          {"verdict"}}};
  std::map<std::string, int> verdicts;  // of what the paper claims
  for (const ShapeVolumes& shape : volumes_by_shape(input)) {
    const Evidence evidence(shape, input);
    for (const Claim& claim : claims.list) {
      const auto measured = [&](const std::string& label) { return evidence.has(label); };
      if (!measured(claim.subject) || std::ranges::none_of(claim.others, measured)) continue;
      for (const std::string& other : opponents(claim, claims, shape, evidence)) {
        const bool named = std::ranges::find(claim.others, other) != claim.others.end();
        if (!evidence.has(other) && other != kAnotherImpact) continue;
        const TableCell value = evidence.evaluate(claim, other);
        if (named) ++verdicts[std::string(judge_claim(value))];
        const std::string statistic =
            claim.metric.empty() ? claim.statistic : claim.statistic + " " + claim.metric;
        table.rows.push_back({claim.name, shape.shape, claim.subject, other,
                              std::string(named ? "yes" : "no"), statistic, value,
                              std::string(judge_claim(value))});
      }
    }
  }
  if (table.rows.empty()) return {};
  Table sayings{.name = "claims_said",
                .title = "What is claimed",
                .columns = {{"claim"}, {"place"}, {"what the paper says"}, {"erratum"}}};
  for (const Claim& claim : claims.list) {
    sayings.rows.push_back({claim.name, claim.place, claim.says, claim.erratum});
  }
  const std::string summary = fmt::format(
      "Of the comparisons that the paper claims, {} hold, {} fail and {} are open in these "
      "results.",
      verdicts["holds"], verdicts["fails"], verdicts["open"]);
  return {.paragraphs = {summary}, .tables = {std::move(table), std::move(sayings)}};
}

}  // namespace fracbench
