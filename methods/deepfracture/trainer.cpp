#include "methods/deepfracture/trainer.h"

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "core/temporary_folder.h"
#include "neural/training_program.h"

namespace fracbench::deepfracture {

void run_trainer(const TrainerCall& call, const Context& context) {
  const std::filesystem::path options = call.checkpoints / "options.json";
  write_file_atomically(options, call.options);
  neural::run_training_program(
      {"train", call.data_set.string(), "--out", call.model.string(), "--checkpoints",
       call.checkpoints.string(), "--options", options.string(), "--threads",
       std::to_string(context.threads), "--device", context.device},
      "deepfracture",
      {.stop = context.stop, .on_epoch = [&](double fraction, double loss) {
         context.progress.update(fmt::format("training, loss {:.5f}", loss), fraction);
       }});
}

double training_seconds(const std::string& options, std::size_t patterns,
                        const TrainingMachine& machine) {
  const TemporaryWorkFolder folder("training-time");
  const std::filesystem::path file = folder.path() / "options.json";
  write_file_atomically(file, options);
  double seconds = 0;
  neural::run_training_program(
      {"time", "--options", file.string(), "--patterns", std::to_string(patterns), "--threads",
       std::to_string(machine.threads), "--device", machine.device},
      "deepfracture",
      {.stop = machine.stop, .on_seconds = [&](double measured) { seconds = measured; }});
  return seconds;
}

}  // namespace fracbench::deepfracture
