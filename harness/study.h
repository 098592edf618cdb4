#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "harness/suite.h"
#include "neural/representation_study.h"

namespace fracbench {

/// A study breaks no shape, so that it has no cells; its suite has a table [study] instead of
/// shapes, scenarios and methods. The one kind that there is, "representations", learns divided
/// images by heart (neural/representation_study.h). The settings of such a suite:
neural::StudySettings study_settings(const Suite& suite);

/// "study: 3 representations x 150 epochs x 32 patterns".
std::string describe_study(const neural::StudySettings& settings);

/// What it takes to make a study, or the rest of one that was stopped.
struct StudyCost {
  std::string study;   ///< as describe_study says it
  bool found = false;  ///< there is nothing to do
  double seconds = 0;

  /// "study: 3 representations x 150 epochs x 32 patterns, about 1 min 2 s", or ", done".
  std::string describe() const;
  /// "study", "found" and "seconds".
  nlohmann::ordered_json as_json() const;
};

struct StudyCall {
  std::filesystem::path folder;  ///< of results
  std::string command = {};      ///< that makes them, see StoredSuite
  int threads = 1;
  std::stop_token stop = {};
  Progress* progress = nullptr;
  std::function<void(std::string_view)> message = {};
};

/// Makes the study of a suite in its results folder, unless it is there; true: it was made now.
/// One process makes it, others wait for that. Where one was stopped or killed, the study goes on,
/// and ends in the same bytes. A damaged one is made again, with a message. Throws InputError for a
/// folder that belongs to another suite or cannot be used, Cancelled.
bool make_study(const Suite& suite, const StudyCall& call);

/// The cost of the study of a suite, measured by some steps of training in some seconds, unless it
/// is in its results folder, which is only looked at. Throws InputError, Cancelled.
StudyCost study_cost(const Suite& suite, const std::filesystem::path& folder,
                     const std::stop_token& stop);

/// The study in a results folder; none: there is no such file. Throws InputError where it is
/// damaged.
std::optional<neural::RepresentationStudy> read_study(const std::filesystem::path& folder);

}  // namespace fracbench
