#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/context.h"
#include "core/target.h"
#include "harness/user_cache.h"
#include "methods/method.h"

namespace fracbench {

/// A body that is wanted.
struct PreparedRequest {
  const Method& method;
  const Options& options;
  const Target& target;
  std::string learning_digest = {};  ///< of what it learns from; empty where it does not learn
  /// Of the other shapes that it learns: the body is then one for all of them.
  std::vector<std::string> further_digests = {};
  std::function<LearningData()> learning = {};  ///< called only where the body has to be made
};

struct PreparedBody {
  std::unique_ptr<Breakable> body;
  double seconds = 0;  ///< that making it took, now or when it was made
};

/// SHA-256 of everything that determines a body: method, sources, options, mesh, material, learning
/// data, and of the context threads, device, and the seed where the method is random. Where several
/// shapes are learned, the same for each of them.
std::string prepared_key(const PreparedRequest& request, const Context& context);

/// SHA-256 of the files that the options name (Method::files); empty where they name none. Throws
/// InputError where one cannot be read.
std::string digest_of_files(const Method& method, const Options& options);

/// Prepared bodies on the disk, by content: see docs/cache.md. Any number of processes may use one
/// folder.
class PreparedStore {
 public:
  explicit PreparedStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Below user_cache_folder().
  static std::optional<PreparedStore> of_user();

  const std::filesystem::path& folder() const { return folder_; }

  /// Reads the body, or makes and keeps it. Where another process is making it, waits for that one.
  /// An entry that is damaged is made anew, with a message on standard error; where the folder
  /// cannot be written, the body is made and not kept. Throws what Method::prepare throws.
  PreparedBody get(const PreparedRequest& request, Context& context) const;

  /// All entries, by key. With `verify` the digests of all files are checked, else only that they
  /// are there.
  std::vector<CacheEntry> list(bool verify = false) const;

  /// Removes an entry. False where it is not there or cannot be removed.
  bool remove(const std::string& key) const;

 private:
  std::filesystem::path entry(const std::string& key) const;

  std::filesystem::path folder_;
};

/// The body from the user's store; made directly where there is none, or where the method says that
/// it is quick (MethodInfo::quick_to_prepare).
PreparedBody prepare_body(const PreparedRequest& request, Context& context);

}  // namespace fracbench
