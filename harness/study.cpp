#include "harness/study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/error.h"
#include "harness/cost_model.h"
#include "harness/record_store.h"
#include "neural/training_program.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "study.data";
constexpr const char* kClaim = "study";

/// Whether the study is there; what is there and not it is told of.
bool is_there(const neural::StudySettings& settings, const fs::path& folder,
              const std::function<void(std::string_view)>& message) {
  try {
    const auto found = read_study(folder);
    if (!found) return false;
    if (found->settings == settings) return true;
    if (message) {
      message(fmt::format("{}: is of other settings; made again", (folder / kFile).string()));
    }
  } catch (const InputError& error) {
    if (message) message(fmt::format("{}; made again", error.what()));
  }
  return false;
}

/// What the training program is asked for.
std::vector<std::string> arguments_for(const neural::StudySettings& settings,
                                       const fs::path& folder, int threads) {
  std::vector<std::string> arguments{"study-2d", "--out", (folder / kFile).string()};
  const auto add = [&](const char* name, const auto& value) {
    arguments.emplace_back(name);
    arguments.push_back(fmt::format("{}", value));
  };
  add("--side", settings.side);
  add("--patterns", settings.patterns);
  add("--least-sites", settings.least_sites);
  add("--most-sites", settings.most_sites);
  add("--epochs", settings.epochs);
  add("--learning-rate", settings.learning_rate);
  add("--seed", settings.seed);
  add("--threads", threads);
  return arguments;
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
  const fs::path file = call.folder / kFile;
  if (is_there(settings, call.folder, call.message)) {
    neural::remove_study_checkpoints(file);  // a process may have been killed just before that
    return false;
  }
  neural::run_training_program(arguments_for(settings, call.folder, call.threads), kClaim,
                               {.stop = call.stop,
                                .on_epoch =
                                    [&](double fraction, double) {
                                      if (call.progress) call.progress->update("study", fraction);
                                    },
                                .on_message = call.message});
  return true;
}

StudyCost study_cost(const Suite& suite, const fs::path& folder, const std::stop_token& stop) {
  const neural::StudySettings settings = study_settings(suite);
  StudyCost cost{.study = describe_study(settings)};
  cost.found = is_there(settings, folder, {});
  if (cost.found) return cost;
  std::vector<std::string> arguments = arguments_for(settings, folder, suite.threads_per_cell);
  arguments.emplace_back("--time");
  neural::run_training_program(
      std::move(arguments), kClaim,
      {.stop = stop, .on_seconds = [&](double seconds) { cost.seconds = seconds; }});
  return cost;
}

std::string StudyCost::describe() const {
  return found ? study + ", done" : fmt::format("{}, about {}", study, describe_seconds(seconds));
}

nlohmann::ordered_json StudyCost::as_json() const {
  return {{"study", study}, {"found", found}, {"seconds", seconds}};
}

std::optional<neural::RepresentationStudy> read_study(const fs::path& folder) {
  const fs::path file = folder / kFile;
  if (!fs::exists(file)) return std::nullopt;
  return neural::read_representation_study(file);
}

}  // namespace fracbench
