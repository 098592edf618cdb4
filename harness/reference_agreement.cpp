#include "harness/reference_agreement.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "core/digest.h"
#include "harness/agreement_cache.h"
#include "harness/build_info.h"
#include "harness/record_store.h"

namespace fracbench {

namespace {

// So many fractures are in memory at a time, and so many comparisons are lost by who is
// interrupted.
constexpr std::size_t kPairsAtATime = 48;

/// Two cells whose fractures are compared.
struct Pair {
  const CellSummary* reference;
  const CellSummary* other;
  bool other_impact;
};

/// In the order of the cells, so that neighbours share the reference.
std::vector<Pair> pairs_of(const std::vector<CellSummary>& cells, const std::string& label) {
  std::map<Collision, const CellSummary*> references;
  for (const CellSummary& cell : cells) {
    if (cell.status == CellStatus::ok && cell.label == label)
      references[collision_of(cell)] = &cell;
  }
  std::vector<Pair> pairs;
  for (const CellSummary& cell : cells) {
    if (cell.status != CellStatus::ok) continue;
    const auto same = references.find(collision_of(cell));
    if (same == references.end()) continue;
    if (cell.label != label) {
      pairs.push_back({same->second, &cell, false});
      continue;
    }
    // The next impact on this shape, in a ring.
    auto next = std::next(same);
    if (next == references.end() || std::get<0>(next->first) != cell.shape) {
      next = references.lower_bound({cell.shape, "", "", 0});
    }
    if (next != same) pairs.push_back({same->second, next->second, true});
  }
  return pairs;
}

std::uint64_t seed_of(const CellSummary& cell) {
  return derive_seed(cell.seed, {"agreement with the reference"});
}

/// Stands for all that the agreement of a pair depends on; the program's sources tell how it is
/// computed (metrics/ and what that uses).
std::string key_of(const Pair& pair, const FractureSamples& samples) {
  Digest digest;
  digest.add(build_info().source_digest);
  for (const int number :
       {samples.resolution, samples.surfaces.fracture_surface, samples.surfaces.fragment}) {
    digest.add(static_cast<std::uint64_t>(number));
  }
  for (const CellSummary* cell : {pair.reference, pair.other}) {
    digest.add(cell->key);
    digest.add(cell->result_digest);
    digest.add(seed_of(*cell));
  }
  return digest.hex();
}

/// Compares pairs; what the pairs before share with these is not read again.
class Comparison {
 public:
  Comparison(const std::filesystem::path& folder, const AgreementOptions& options)
      : folder_(folder), options_(options) {}

  std::vector<FractureAgreement> operator()(std::span<const Pair> pairs) {
    hold_fractures_of(pairs);
    std::vector<FractureAgreement> result(pairs.size());
    parallel_for(pairs.size(), options_.threads, [&](std::size_t i) {
      result[i] = fractures_.at(pairs[i].reference)->agreement(*fractures_.at(pairs[i].other));
    });
    return result;
  }

 private:
  using Fractures = std::map<const CellSummary*, std::optional<ComparableFracture>>;

  void hold_fractures_of(std::span<const Pair> pairs) {
    std::set<const CellSummary*> wanted;
    for (const Pair& pair : pairs) wanted.insert({pair.reference, pair.other});
    std::erase_if(fractures_, [&](const auto& held) { return !wanted.contains(held.first); });
    std::vector<Fractures::value_type*> missing;
    for (const CellSummary* cell : wanted) {
      const auto [place, is_new] = fractures_.try_emplace(cell);
      if (is_new) missing.push_back(&*place);
    }
    parallel_for(missing.size(), options_.threads, [&](std::size_t i) {
      auto& [cell, fracture] = *missing[i];
      Random random(seed_of(*cell));
      fracture.emplace(read_record(folder_, cell->key).outcome.scene.fragments, options_.samples,
                       random);
    });
  }

  const std::filesystem::path& folder_;
  const AgreementOptions& options_;
  Fractures fractures_;
};

}  // namespace

std::vector<ReferenceAgreement> agreement_with_reference(const std::filesystem::path& folder,
                                                         const std::vector<CellSummary>& cells,
                                                         const AgreementOptions& options) {
  AgreementCache cache(folder);
  std::vector<ReferenceAgreement> result;
  std::vector<Pair> missing;
  std::vector<std::string> keys;    // of the missing ones
  std::vector<std::size_t> places;  // likewise, in the result
  for (const Pair& pair : pairs_of(cells, options.reference)) {
    const CellSummary& reference = *pair.reference;
    result.push_back({.shape = reference.shape,
                      .label = pair.other->label,
                      .family = reference.family,
                      .scenario = reference.scenario,
                      .repeat = reference.repeat,
                      .other_impact = pair.other_impact});
    std::string key = key_of(pair, options.samples);
    if (const auto known = cache.find(key)) {
      result.back().agreement = *known;
      continue;
    }
    missing.push_back(pair);
    keys.push_back(std::move(key));
    places.push_back(result.size() - 1);
  }
  Comparison compare(folder, options);
  for (std::size_t first = 0; first < missing.size(); first += kPairsAtATime) {
    const std::size_t count = std::min(kPairsAtATime, missing.size() - first);
    const auto agreements = compare(std::span(missing).subspan(first, count));
    cache.keep(std::span(keys).subspan(first, count), agreements);
    for (std::size_t i = 0; i < count; ++i) result[places[first + i]].agreement = agreements[i];
  }
  return result;
}

}  // namespace fracbench
