#include "training/checkpoint.h"

#include <fmt/format.h>
#include <torch/torch.h>

#include "core/array_file.h"
#include "core/error.h"
#include "training/network.h"

namespace fracbench::training {

namespace {

constexpr ArrayFileKind kKind{.format = "fracbench checkpoint", .version = 1};

}  // namespace

std::filesystem::path checkpoint_file(const std::filesystem::path& folder) {
  return folder / "training.checkpoint";
}

void write_checkpoint(const std::filesystem::path& folder, const TrainingState& state,
                      const std::map<std::string, torch::Tensor>& tensors) {
  ArrayFile file;
  file.texts["training"] = state.training;
  file.reals["steps"] = {static_cast<double>(state.steps)};
  for (const neural::EpochRecord& epoch : state.epochs) {
    file.reals["epoch_loss"].push_back(epoch.loss);
    file.reals["epoch_seconds"].push_back(epoch.seconds);
  }
  ArrayViews views = file;
  std::vector<torch::Tensor> plain;  // of numbers in order, on the processor
  for (const auto& [name, tensor] : tensors) {
    const torch::Tensor& values = plain.emplace_back(in_order(tensor));
    views.floats[name] = {values.data_ptr<float>(), static_cast<std::size_t>(values.numel())};
  }
  write_array_file(checkpoint_file(folder), views, kKind);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder) {
  const std::filesystem::path path = checkpoint_file(folder);
  if (!std::filesystem::exists(path)) return std::nullopt;
  ArrayFile file = read_array_file(path, kKind);
  Checkpoint found{.state = {.training = file.texts["training"], .epochs = {}},
                   .arrays = std::move(file.floats)};
  const std::vector<double>& loss = file.reals["epoch_loss"];
  const std::vector<double>& seconds = file.reals["epoch_seconds"];
  if (file.reals["steps"].size() != 1 || loss.size() != seconds.size()) {
    throw InputError(fmt::format("'{}' is damaged", path.string()));
  }
  found.state.steps = static_cast<std::int64_t>(file.reals["steps"][0]);
  for (std::size_t k = 0; k < loss.size(); ++k) {
    found.state.epochs.push_back({loss[k], seconds[k]});
  }
  return found;
}

void put_arrays(const Checkpoint& from, std::map<std::string, torch::Tensor> tensors) {
  for (const auto& [name, tensor] : tensors) {
    const auto found = from.arrays.find(name);
    if (found == from.arrays.end() ||
        found->second.size() != static_cast<std::size_t>(tensor.numel())) {
      throw InputError(fmt::format("the check point has no fitting '{}'", name));
    }
  }
  const torch::NoGradGuard none;
  for (auto& [name, tensor] : tensors) {
    tensor.copy_(tensor_of(from.arrays.at(name), tensor.sizes()));
  }
}

}  // namespace fracbench::training
