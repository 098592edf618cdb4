#include "harness/agreement_cache.h"

#include <nlohmann/json.hpp>

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const FractureAgreement& agreement) {
  const auto& [partition, surfaces, fragment_chamfer] = agreement;
  Json json{{"partition",
             {partition.adjusted_rand, partition.variation_of_information, partition.matched_iou}}};
  if (surfaces) json["surfaces"] = {surfaces->chamfer, surfaces->hausdorff_95};
  if (fragment_chamfer) json["fragment_chamfer"] = *fragment_chamfer;
  return json;
}

FractureAgreement agreement_from_json(const Json& json) {
  const Json& partition = json.at("partition");
  FractureAgreement agreement{.partition = {.adjusted_rand = partition.at(0),
                                            .variation_of_information = partition.at(1),
                                            .matched_iou = partition.at(2)}};
  if (json.contains("surfaces")) {
    const Json& surfaces = json.at("surfaces");
    agreement.surfaces = {.chamfer = surfaces.at(0), .hausdorff_95 = surfaces.at(1)};
  }
  if (json.contains("fragment_chamfer")) {
    agreement.fragment_chamfer = json.at("fragment_chamfer").get<double>();
  }
  return agreement;
}

}  // namespace

AgreementCache::AgreementCache(const std::filesystem::path& folder)
    : lines_(folder / "agreements") {
  lines_.read([this](const Json& line) {
    known_.insert_or_assign(line.at("key"), agreement_from_json(line.at("agreement")));
  });
}

std::optional<FractureAgreement> AgreementCache::find(const std::string& key) const {
  const auto found = known_.find(key);
  return found == known_.end() ? std::nullopt : std::optional(found->second);
}

void AgreementCache::keep(std::span<const std::string> keys,
                          std::span<const FractureAgreement> agreements) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    texts.push_back(Json{{"key", keys[i]}, {"agreement", to_json(agreements[i])}}.dump());
  }
  lines_.append(texts);
}

}  // namespace fracbench
