#include "harness/study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "harness/record_store.h"
#include "neural/training_program.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "study.data";
constexpr const char* kClaim = "study";

/// Whether the study is there; what is there and not it is told of.
bool is_there(const neural::StudySettings& settings, const StudyCall& call) {
  try {
    const auto found = read_study(call.folder);
    if (!found) return false;
    if (found->settings == settings) return true;
    if (call.message) {
      call.message(
          fmt::format("{}: is of other settings; made again", (call.folder / kFile).string()));
    }
  } catch (const InputError& error) {
    if (call.message) call.message(fmt::format("{}; made again", error.what()));
  }
  return false;
}

}  // namespace

neural::StudySettings study_settings(const Suite& suite) {
  const Options& options = *suite.study;
  const auto whole = [&](const char* name) { return static_cast<int>(options.integer(name)); };
  return {.side = whole("side"),
          .patterns = whole("patterns"),
          .least_sites = whole("least_sites"),
          .most_sites = whole("most_sites"),
          .epochs = whole("epochs"),
          .learning_rate = options.number("learning_rate"),
          .seed = suite.seed};
}

std::string describe_study(const neural::StudySettings& settings) {
  return fmt::format("study: {} representations x {} epochs x {} patterns",
                     neural::kRepresentations.size(), settings.epochs, settings.patterns);
}

bool make_study(const Suite& suite, const StudyCall& call) {
  const neural::StudySettings settings = study_settings(suite);
  const RecordStore store(call.folder);
  store.bind_suite({.name = suite.name,
                    .summary = suite.summary,
                    .values = to_json(suite),
                    .cells = 0,
                    .command = call.command});
  const Claim claim = store.wait_for_claim(kClaim, call.stop);
  if (is_there(settings, call)) return false;
  neural::run_training_program(
      {"study-2d", "--out", (call.folder / kFile).string(), "--side",
       fmt::format("{}", settings.side), "--patterns", fmt::format("{}", settings.patterns),
       "--least-sites", fmt::format("{}", settings.least_sites), "--most-sites",
       fmt::format("{}", settings.most_sites), "--epochs", fmt::format("{}", settings.epochs),
       "--learning-rate", fmt::format("{}", settings.learning_rate), "--seed",
       fmt::format("{}", settings.seed), "--threads", fmt::format("{}", call.threads)},
      "study", {.stop = call.stop, .on_epoch = [&](double fraction, double) {
                  if (call.progress) call.progress->update("study", fraction);
                }});
  return true;
}

std::optional<neural::RepresentationStudy> read_study(const fs::path& folder) {
  const fs::path file = folder / kFile;
  if (!fs::exists(file)) return std::nullopt;
  return neural::read_representation_study(file);
}

}  // namespace fracbench
