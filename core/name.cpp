#include "core/name.h"

#include <mutex>
#include <unordered_set>

namespace fracbench {

namespace {

struct Hash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const {
    return std::hash<std::string_view>()(text);
  }
};

/// The one copy of a text. Never taken apart: names may outlive everything else.
const std::string& kept(std::string_view text) {
  static std::mutex mutex;
  static auto& texts = *new std::unordered_set<std::string, Hash, std::equal_to<>>();
  const std::scoped_lock lock(mutex);
  const auto found = texts.find(text);
  return found != texts.end() ? *found : *texts.emplace(text).first;
}

}  // namespace

Name::Name(std::string_view text) : text_(&kept(text)) {}

}  // namespace fracbench
