#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace fracbench {

/// What the program answered to one call.
struct Answer {
  int exit_code = -1;  ///< negative: killed by that signal
  std::string output;
  std::string errors;

  nlohmann::json json() const { return nlohmann::json::parse(output); }
};

/// Runs the built `fracbench` with these arguments, as a shell would split them, in `folder`; with
/// a cache where one is named.
Answer call(const std::string& arguments, const std::filesystem::path& folder,
            const std::filesystem::path& cache = {});

/// The same with the output sent to that file instead of into the answer.
Answer call_with_output(const std::string& arguments, const std::filesystem::path& folder,
                        const std::filesystem::path& output,
                        const std::filesystem::path& cache = {});

/// An empty folder that is removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file in the folder and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const;
  std::string read(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

}  // namespace fracbench
