#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "harness/kept_lines.h"
#include "metrics/fracture_agreement.h"

namespace fracbench {

/// Agreements of fractures that were computed once, in agreements/ of a results folder (KeptLines).
/// Their keys stand for everything that determines them; what cannot be read is not there.
class AgreementCache {
 public:
  /// Reads what is there. `folder` is the results folder.
  explicit AgreementCache(const std::filesystem::path& folder);

  std::optional<FractureAgreement> find(const std::string& key) const;

  /// Writes them at once, where the folder can be written. `keys` and `agreements` are parallel.
  void keep(std::span<const std::string> keys, std::span<const FractureAgreement> agreements);

 private:
  KeptLines lines_;
  std::map<std::string, FractureAgreement> known_;
};

}  // namespace fracbench
