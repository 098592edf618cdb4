#include "harness/exit_code.h"

#include <filesystem>

#include "core/error.h"

namespace fracbench {

ExitCode exit_code_of(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error)) return ExitCode::bad_input;
  // A file or folder of the user's that cannot be looked at.
  if (dynamic_cast<const std::filesystem::filesystem_error*>(&error)) return ExitCode::bad_input;
  if (dynamic_cast<const Cancelled*>(&error)) return ExitCode::not_measured;
  if (dynamic_cast<const MethodFailure*>(&error)) return ExitCode::not_measured;
  return ExitCode::internal;
}

ExitCode exit_code_of(const RunResult& result) {
  const std::size_t lost = result.count(CellStatus::timeout) +
                           result.count(CellStatus::out_of_memory) +
                           result.count(CellStatus::crash);
  const bool good = result.complete() && result.measured() > 0 && lost == 0;
  return good ? ExitCode::good : ExitCode::not_measured;
}

}  // namespace fracbench
