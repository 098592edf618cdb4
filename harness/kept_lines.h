#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace fracbench {

/// Values that cost time to find out, kept as lines of JSON in the files *.jsonl of a folder, each
/// line with a checksum. Every process appends to a file of its own, so that any number of them may
/// read and write at once. Losing the folder costs time alone; where it cannot be written, nothing
/// is kept and nobody is bothered.
class KeptLines {
 public:
  explicit KeptLines(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Hands every line over, in no order. One that was cut short or damaged is passed over, as is
  /// one that `take` cannot read (nlohmann::json::exception, std::bad_optional_access).
  void read(const std::function<void(const nlohmann::ordered_json&)>& take) const;

  /// Each text is the JSON of one line, without a line break.
  void append(const std::vector<std::string>& texts);

  /// False once writing has failed.
  bool writable() const { return writable_; }

 private:
  const std::filesystem::path folder_;
  std::filesystem::path file_;  ///< this process's own; empty until it has something to say
  bool writable_ = true;
};

}  // namespace fracbench
