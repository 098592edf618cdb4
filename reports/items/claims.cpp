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
    const Collisions collisions = by_collision(pooled);
    return estimate(collisions.size(), statistic(claim, other, collisions), input_,
                    fmt::format("{} {} {}", shape_.shape, claim.name, other));
  }

 private:
  using Collisions = std::vector<Cells>;
  using Chosen = std::span<const std::size_t>;

  ClusterStatistic statistic(const Claim& claim, const std::string& other,
                             const Collisions& collisions) const {
    const auto& subject = claim.subject;
    if (claim.statistic == "volume-distance") {
      const auto volumes = [&](std::string_view label) {
        return CollisionVolumes(collisions, label, shape_.cut);
      };
      return nearer(volumes(subject), volumes(other), volumes(kReference),
                    [](auto a, auto b) { return wasserstein(a, b); });
    }
    if (claim.statistic == "agreement") {
      return above(agreements(collisions, subject), agreements(collisions, other));
    }
    const auto values = [&](std::string_view label) {
      return CollisionValues(collisions, [&](const CellSummary& cell) {
        return cell.label == label ? value_of(cell, claim.metric) : std::nullopt;
      });
    };
    if (claim.statistic == "mean-difference") return above(values(subject), values(other));
    if (claim.statistic == "mean-distance") {
      return nearer(values(subject), values(other), values(kReference),
                    [](auto a, auto b) { return std::abs(mean(a) - mean(b)); });
    }
    throw InputError(fmt::format("published claim '{}': there is no statistic '{}'", claim.name,
                                 claim.statistic));
  }

  CollisionValues agreements(const Collisions& collisions, const std::string& label) const {
    const std::string_view cells_of = label == kAnotherImpact ? kReference : label;
    return {collisions, [&](const CellSummary& cell) -> std::optional<double> {
              if (cell.label != cells_of) return std::nullopt;
              const auto found = agreement_.find({label, cell.family, cell.scenario, cell.repeat});
              return found == agreement_.end() ? std::nullopt : std::optional(found->second);
            }};
  }

  static double mean(std::span<const double> values) { return summarize(values).mean; }

  /// How much larger the mean of the subject is than that of the other.
  static ClusterStatistic above(CollisionValues subject, CollisionValues other) {
    return [subject = std::move(subject),
            other = std::move(other)](Chosen chosen) -> std::optional<double> {
      const std::vector<double> a = subject.of(chosen);
      const std::vector<double> b = other.of(chosen);
      if (a.empty() || b.empty()) return std::nullopt;
      return mean(a) - mean(b);
    };
  }

  /// How much nearer to the reference the subject is than the other.
  template <typename Data, typename Distance>
  static ClusterStatistic nearer(Data subject, Data other, Data reference, Distance distance) {
    return [subject = std::move(subject), other = std::move(other),
            reference = std::move(reference), distance](Chosen chosen) -> std::optional<double> {
      const std::vector<double> a = subject.of(chosen);
      const std::vector<double> b = other.of(chosen);
      const std::vector<double> c = reference.of(chosen);
      if (a.empty() || b.empty() || c.empty()) return std::nullopt;
      return distance(b, c) - distance(a, c);
    };
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
