#include "training/checkpoint.h"

#include <fmt/format.h>

#include "core/array_file.h"
#include "core/error.h"

namespace fracbench::training {

namespace {

constexpr ArrayFileKind kKind{.format = "fracbench checkpoint", .version = 1};

std::filesystem::path file_in(const std::filesystem::path& folder) {
  return folder / "training.checkpoint";
}

}  // namespace

void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& state) {
  ArrayFile file;
  file.texts["training"] = state.training;
  file.reals["steps"] = {static_cast<double>(state.steps)};
  for (const neural::EpochRecord& epoch : state.epochs) {
    file.reals["epoch_loss"].push_back(epoch.loss);
    file.reals["epoch_seconds"].push_back(epoch.seconds);
  }
  file.floats = state.arrays;
  write_array_file(file_in(folder), file, kKind);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                          const std::string& training) {
  const std::filesystem::path path = file_in(folder);
  if (!std::filesystem::exists(path)) return std::nullopt;
  ArrayFile file = read_array_file(path, kKind);
  if (file.texts["training"] != training) {
    throw InputError(
        fmt::format("'{}' is of a training with other data or options; give another folder, or "
                    "remove it to begin anew",
                    path.string()));
  }
  Checkpoint state{.training = training, .epochs = {}, .arrays = std::move(file.floats)};
  const std::vector<double>& loss = file.reals["epoch_loss"];
  const std::vector<double>& seconds = file.reals["epoch_seconds"];
  if (file.reals["steps"].size() != 1 || loss.size() != seconds.size()) {
    throw InputError(fmt::format("'{}' is damaged; remove it to begin anew", path.string()));
  }
  state.steps = static_cast<std::int64_t>(file.reals["steps"][0]);
  for (std::size_t k = 0; k < loss.size(); ++k) state.epochs.push_back({loss[k], seconds[k]});
  return state;
}

}  // namespace fracbench::training
