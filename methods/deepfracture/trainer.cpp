#include "methods/deepfracture/trainer.h"

#include <fmt/format.h>

#include "core/atomic_file.h"
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

}  // namespace fracbench::deepfracture
