#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fracbench {

/// Why results became the baseline.
struct Acceptance {
  std::string when;  ///< UTC, as 2026-01-31T12:00:00Z
  std::string who;
  std::string why;
  std::string suite;
  std::size_t cells = 0;
  bool operator==(const Acceptance&) const = default;
};

nlohmann::ordered_json to_json(const Acceptance& note);
/// Throws nlohmann::json::exception.
Acceptance acceptance_from_json(const nlohmann::ordered_json& json);

}  // namespace fracbench
