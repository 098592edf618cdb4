#include "methods/deepfracture/trainer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <system_error>

#include "core/atomic_file.h"
#include "core/child_process.h"
#include "core/error.h"

namespace fracbench::deepfracture {

namespace {

constexpr int kBadInput = 2;

/// "epoch 12 200 0.00123 35.5": tells how far it is.
void report(std::string_view line, const Context& context) {
  std::istringstream words{std::string(line)};
  std::string word;
  double done = 0, all = 0, loss = 0;
  if (words >> word >> done >> all >> loss && word == "epoch" && all > 0) {
    context.progress.update(fmt::format("training, loss {:.5f}", loss), done / all);
  }
}

}  // namespace

std::filesystem::path trainer_program() {
  if (const char* named = std::getenv("FRACBENCH_TRAINER")) return named;
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path program = self.parent_path() / "fracbench-train";
  if (::access(program.c_str(), X_OK) != 0) {
    throw InputError(
        fmt::format("deepfracture: the program '{}' is not there; build the target "
                    "fracbench-train, or name it in FRACBENCH_TRAINER",
                    program.string()));
  }
  return program;
}

void run_trainer(const TrainerCall& call, const Context& context) {
  const std::filesystem::path options = call.checkpoints / "options.json";
  write_file_atomically(options, call.options);
  const ChildResult result = run_child(
      {trainer_program().string(), "train", call.data_set.string(), "--out", call.model.string(),
       "--checkpoints", call.checkpoints.string(), "--options", options.string(), "--threads",
       std::to_string(context.threads), "--device", context.device, "--progress-lines"},
      {.stop = context.stop, .on_line = [&](std::string_view line) { report(line, context); }});
  if (result.good()) return;
  if (result.signal == 0 && result.exit_code == kBadInput) {
    throw InputError(fmt::format("deepfracture: {}", result.said));
  }
  throw MethodFailure(fmt::format("deepfracture: the training ended {}", result.describe()));
}

}  // namespace fracbench::deepfracture
