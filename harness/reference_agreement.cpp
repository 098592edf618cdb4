#include "harness/reference_agreement.h"

#include <map>
#include <mutex>

#include "core/parallel.h"
#include "geometry/fragment_labels.h"
#include "harness/record_store.h"

namespace fracbench {

namespace {

/// One fracture, ready to be compared.
struct Fracture {
  std::vector<std::int32_t> labels;
  SampledFracture surfaces;
};

class Reader {
 public:
  Reader(const std::filesystem::path& folder, const AgreementOptions& options)
      : folder_(folder), options_(options) {}

  Fracture operator()(const CellSummary& cell) {
    Fragments fragments;
    {
      const std::scoped_lock one_at_a_time(mutex_);  // HDF5 knows no threads
      fragments = read_record(folder_, cell.key).outcome.scene.fragments;
    }
    Random random(derive_seed(cell.seed, {"agreement with the reference"}));
    return {.labels =
                fragment_labels(fragments, unit_grid<std::int32_t>(options_.resolution), 1).values,
            .surfaces = SampledFracture(fragments, options_.samples, random)};
  }

 private:
  const std::filesystem::path& folder_;
  const AgreementOptions& options_;
  std::mutex mutex_;
};

ReferenceAgreement compare(const CellSummary& cell, bool other_impact, const Fracture& reference,
                           const Fracture& fracture) {
  return {.shape = cell.shape,
          .label = cell.label,
          .family = cell.family,
          .scenario = cell.scenario,
          .repeat = cell.repeat,
          .other_impact = other_impact,
          .partition = partition_agreement(reference.labels, fracture.labels),
          .surfaces = reference.surfaces.surface_agreement(fracture.surfaces),
          .fragment_chamfer = reference.surfaces.fragment_chamfer(fracture.surfaces)};
}

}  // namespace

std::vector<ReferenceAgreement> agreement_with_reference(const std::filesystem::path& folder,
                                                         const std::vector<CellSummary>& cells,
                                                         const AgreementOptions& options) {
  Reader read(folder, options);
  std::map<Collision, std::optional<Fracture>> reference;
  std::vector<const CellSummary*> broken;
  for (const CellSummary& cell : cells) {
    if (cell.status != CellStatus::ok) continue;
    broken.push_back(&cell);
    if (cell.label == options.reference) reference.try_emplace(collision_of(cell));
  }
  parallel_for(broken.size(), options.threads, [&](std::size_t i) {
    if (broken[i]->label == options.reference) {
      reference.at(collision_of(*broken[i])) = read(*broken[i]);
    }
  });
  std::vector<std::optional<ReferenceAgreement>> found(broken.size());
  parallel_for(broken.size(), options.threads, [&](std::size_t i) {
    const CellSummary& cell = *broken[i];
    const auto same = reference.find(collision_of(cell));
    if (same == reference.end()) return;
    if (cell.label != options.reference) {
      found[i] = compare(cell, false, *same->second, read(cell));
      return;
    }
    // The next impact on this shape, in a ring.
    auto next = std::next(same);
    if (next == reference.end() || std::get<0>(next->first) != cell.shape) {
      next = reference.lower_bound({cell.shape, "", "", 0});
    }
    if (next != same) found[i] = compare(cell, true, *same->second, *next->second);
  });
  std::vector<ReferenceAgreement> result;
  for (auto& agreement : found) {
    if (agreement) result.push_back(std::move(*agreement));
  }
  return result;
}

}  // namespace fracbench
