#include "harness/catalog.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace fracbench {

namespace {

template <typename Part>
const Part& find(std::span<const std::unique_ptr<Part>> parts, std::string_view kind,
                 std::string_view name, std::string_view where) {
  std::vector<std::string> names;
  for (const auto& part : parts) {
    names.push_back(part->info().name);
    if (names.back() == name) return *part;
  }
  throw InputError(
      fmt::format("{}: unknown {} '{}'{}", where, kind, name, did_you_mean(name, names)));
}

}  // namespace

const Method& Catalog::method(std::string_view name, std::string_view where) const {
  return find(methods, "method", name, where);
}

const ScenarioFamily& Catalog::family(std::string_view name, std::string_view where) const {
  return find(families, "scenario family", name, where);
}

}  // namespace fracbench
