#include "neural/training_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <system_error>

#include "core/child_process.h"
#include "core/error.h"

namespace fracbench::neural {

namespace {

constexpr int kBadInput = 2;

/// "epoch 12 200 0.00123 35.5", "seconds 35.5" or "message ...".
void tell(std::string_view line, const TrainingWatch& watch) {
  std::istringstream words{std::string(line)};
  std::string word;
  words >> word;
  double done = 0, all = 0, loss = 0;
  if (word == "epoch" && watch.on_epoch && words >> done >> all >> loss && all > 0) {
    watch.on_epoch(done / all, loss);
  }
  double seconds = 0;
  if (word == "seconds" && watch.on_seconds && words >> seconds) watch.on_seconds(seconds);
  if (word == "message" && watch.on_message && words.get() == ' ') {
    std::getline(words, word);
    watch.on_message(word);
  }
}

}  // namespace

std::filesystem::path training_program() {
  if (const char* named = std::getenv("FRACBENCH_TRAINER")) return named;
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path program = self.parent_path() / "fracbench-train";
  if (::access(program.c_str(), X_OK) != 0) {
    throw InputError(
        fmt::format("the program '{}', which trains networks, is not there; build the target "
                    "fracbench-train, or name it in FRACBENCH_TRAINER",
                    program.string()));
  }
  return program;
}

void run_training_program(std::vector<std::string> arguments, std::string_view whose,
                          const TrainingWatch& watch) {
  arguments.insert(arguments.begin(), training_program().string());
  arguments.emplace_back("--progress-lines");
  const ChildResult result =
      run_child(std::move(arguments),
                {.stop = watch.stop, .on_line = [&](std::string_view line) { tell(line, watch); }});
  if (result.good()) return;
  if (result.signal == 0 && result.exit_code == kBadInput) {
    throw InputError(fmt::format("{}: {}", whose, result.said));
  }
  throw MethodFailure(fmt::format("{}: the training ended {}", whose, result.describe()));
}

}  // namespace fracbench::neural
