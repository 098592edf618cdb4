#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
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

struct StudyCall {
  std::filesystem::path folder;  ///< of results
  std::string command = {};      ///< that makes them, see StoredSuite
  int threads = 1;
  std::stop_token stop = {};
  Progress* progress = nullptr;
  std::function<void(std::string_view)> message = {};
};

/// Makes the study of a suite in its results folder, unless it is there; true: it was made now.
/// One process makes it, others wait for that. A damaged one is made again, with a message. Throws
/// InputError for a folder that belongs to another suite or cannot be used, Cancelled.
bool make_study(const Suite& suite, const StudyCall& call);

/// The study in a results folder; none: there is no such file. Throws InputError where it is
/// damaged.
std::optional<neural::RepresentationStudy> read_study(const std::filesystem::path& folder);

}  // namespace fracbench
