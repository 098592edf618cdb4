#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cell_status.h"
#include "harness/plan.h"

namespace fracbench {

/// What a collision is good for.
enum class LearningRole : std::uint8_t {
  train,     ///< it broke; to learn from
  test,      ///< it broke; kept for tests
  spare,     ///< it broke, and there are enough without it
  unbroken,  ///< the target stayed whole
  failed,    ///< the method could not answer, or its fragments are not sound
};

inline constexpr std::array kLearningRoles = {LearningRole::train, LearningRole::test,
                                              LearningRole::spare, LearningRole::unbroken,
                                              LearningRole::failed};

std::string_view to_string(LearningRole role);
std::optional<LearningRole> parse_learning_role(std::string_view text);

/// One collision, without its fragments.
struct LearningRecord {
  std::string key;       ///< of the record, which is records/<key>.h5
  std::string scenario;  ///< "single-0003"
  LearningRole role = LearningRole::failed;
  CellStatus status = CellStatus::ok;
  std::string reason = {};
  /// Magnitudes on the target in the impact that broke it, else in the strongest one that did not,
  /// strongest first, N s.
  std::vector<double> impulses = {};
  std::string result_digest = {};  ///< of what was measured, see docs/records.md
};

/// The collisions with one shape, in the order of their scenes.
struct LearningShape {
  std::string label;
  std::string name;         ///< of the shape
  std::string mesh_digest;  ///< its mesh is shapes/<digest>.h5
  std::string digest;       ///< see learning_digest
  double max_impulse = 0;   ///< I_max: over all collisions but the failed ones, N s
  std::vector<LearningRecord> records;

  std::size_t count(LearningRole role) const;
  std::size_t broken() const;
};

/// Which record of a folder of learning data is for what.
struct LearningIndex {
  std::string suite;
  std::string method;
  std::string method_options;  ///< JSON
  std::string family;
  std::uint64_t seed = 0;
  LearningSplit split;
  std::vector<LearningShape> shapes;

  std::size_t count(LearningRole role) const;
  /// Throws InputError where there is no shape of this label; `where` names the data.
  const LearningShape& shape(std::string_view label, std::string_view where) const;
};

/// Divides what broke: an order of the scenes that follows from the seed alone; the first are for
/// tests, the next to learn from, what is beyond both is spare. Where less broke than is wanted, it
/// is divided in the proportion of the two. Changes the roles train, test and spare only.
void divide(LearningShape& shape, const LearningSplit& split, std::uint64_t seed);

/// The index of a plan all of whose records are in `folder`. Throws DataError where one is missing
/// or damaged.
LearningIndex index_learning_data(const Plan& plan, const LearningSplit& split,
                                  const std::filesystem::path& folder);

nlohmann::ordered_json to_json(const LearningIndex& index);
/// Throws InputError where the value is no index; `where` names its file.
LearningIndex learning_index_from_json(const nlohmann::ordered_json& json, std::string_view where);

/// Writes and reads learning.json in a folder of learning data; the same records give the same
/// bytes. Both throw InputError.
void write_learning_index(const LearningIndex& index, const std::filesystem::path& folder);
LearningIndex read_learning_index(const std::filesystem::path& folder);

}  // namespace fracbench
