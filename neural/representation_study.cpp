#include "neural/representation_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/array_file.h"
#include "core/error.h"
#include "neural/made_of_file.h"

namespace fracbench::neural {

namespace {

using Json = nlohmann::ordered_json;

constexpr ArrayFileKind kKind{.format = "fracbench study", .version = 1, .packed = true};
constexpr const char* kSettings = "settings";
constexpr const char* kTrueRegions = "true_regions";
constexpr int kMostSide = 4096, kMostPatterns = 1'000'000;

std::string name_of(Representation representation, std::string_view what) {
  return fmt::format("{}/{}", to_string(representation), what);
}

StudySettings settings_from(const Json& json) {
  return {.side = json.at("side"),
          .patterns = json.at("patterns"),
          .least_sites = json.at("least_sites"),
          .most_sites = json.at("most_sites"),
          .epochs = json.at("epochs"),
          .learning_rate = json.at("learning_rate"),
          .seed = json.at("seed")};
}

/// What a named list has to be: as long as it should be, and finite.
template <typename T>
std::vector<T> taken(std::map<std::string, std::vector<T>>& from, const std::string& name,
                     std::size_t count) {
  std::vector<T> values = std::move(from[name]);
  if (values.size() != count ||
      !std::ranges::all_of(values, [](T v) { return std::isfinite(static_cast<double>(v)); })) {
    throw InputError(fmt::format("its {} do not fit", name));
  }
  return values;
}

RepresentationStudy study_from(ArrayFile& file) {
  RepresentationStudy study{.settings = settings_from(Json::parse(file.texts[kSettings])),
                            .true_regions = {},
                            .outcomes = {}};
  const StudySettings& s = study.settings;
  if (s.side < 1 || s.side > kMostSide || s.patterns < 1 || s.patterns > kMostPatterns ||
      s.epochs < 1) {
    throw InputError("its settings do not fit");
  }
  const auto patterns = static_cast<std::size_t>(s.patterns);
  const auto epochs = static_cast<std::size_t>(s.epochs);
  const std::size_t pixels = patterns * static_cast<std::size_t>(s.side) * s.side;
  study.true_regions = taken(file.reals, kTrueRegions, patterns);
  for (const Representation r : kRepresentations) {
    study.outcomes.push_back({.representation = r,
                              .loss = taken(file.reals, name_of(r, "loss"), epochs),
                              .agreement = taken(file.reals, name_of(r, "agreement"), patterns),
                              .ceiling = taken(file.reals, name_of(r, "ceiling"), patterns),
                              .regions = taken(file.reals, name_of(r, "regions"), patterns),
                              .targets = taken(file.floats, name_of(r, "targets"), pixels),
                              .decoded = taken(file.floats, name_of(r, "decoded"), pixels),
                              .back = taken(file.integers, name_of(r, "back"), pixels)});
    if (std::ranges::any_of(study.outcomes.back().back, [](auto region) { return region < 0; })) {
      throw InputError(fmt::format("its {} do not fit", name_of(r, "back")));
    }
  }
  return study;
}

}  // namespace

std::string_view to_string(Representation value) {
  switch (value) {
    case Representation::labels:
      return "labels";
    case Representation::lines:
      return "lines";
    case Representation::distance:
      return "distance";
  }
  return "";
}

nlohmann::ordered_json to_json(const StudySettings& s) {
  return {{"side", s.side},
          {"patterns", s.patterns},
          {"least_sites", s.least_sites},
          {"most_sites", s.most_sites},
          {"epochs", s.epochs},
          {"learning_rate", s.learning_rate},
          {"seed", s.seed}};
}

void write_representation_study(const std::filesystem::path& file,
                                const RepresentationStudy& study) {
  ArrayFile arrays;
  arrays.texts[kSettings] = to_json(study.settings).dump();
  arrays.reals[kTrueRegions] = study.true_regions;
  for (const StudyOutcome& outcome : study.outcomes) {
    const auto named = [&](std::string_view what) { return name_of(outcome.representation, what); };
    arrays.reals[named("loss")] = outcome.loss;
    arrays.reals[named("agreement")] = outcome.agreement;
    arrays.reals[named("ceiling")] = outcome.ceiling;
    arrays.reals[named("regions")] = outcome.regions;
    arrays.floats[named("targets")] = outcome.targets;
    arrays.floats[named("decoded")] = outcome.decoded;
    arrays.integers[named("back")] = outcome.back;
  }
  write_array_file(file, arrays, kKind);
}

std::filesystem::path study_checkpoints(const std::filesystem::path& file) {
  return file.string() + ".checkpoints";
}

void remove_study_checkpoints(const std::filesystem::path& file) {
  const std::filesystem::path folder = study_checkpoints(file);
  std::error_code ignored;
  for (const Representation r : kRepresentations) {
    std::filesystem::remove_all(folder / to_string(r), ignored);
  }
  std::filesystem::remove(folder, ignored);  // unless it holds what is not ours
}

RepresentationStudy read_representation_study(const std::filesystem::path& file) {
  return made_of_file(file, kKind, study_from);
}

}  // namespace fracbench::neural
