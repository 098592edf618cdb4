#include "scenarios/families/imported.h"

#include "core/collision_folder.h"
#include "core/error.h"
#include "scenarios/break_test.h"
#include "scenarios/families/common_options.h"
#include "scenarios/scenario_options.h"

namespace fracbench {

FamilyInfo ImportedFamily::info() const {
  return {.name = "imported",
          .summary = "the impulses of collisions whose fragments some tool has made"};
}

OptionsSchema ImportedFamily::options() const {
  const OptionsSchema schema = {{.name = "path",
                                 .fallback = std::string(),
                                 .unit = "",
                                 .summary = "folder with a folder for each collision "
                                            "(docs/import.md)"},
                                {.name = "count",
                                 .fallback = std::int64_t{0},
                                 .unit = "",
                                 .summary = "number of collisions; 0: all",
                                 .minimum = 0,
                                 .maximum = 1e6},
                                {.name = "break_test",
                                 .fallback = std::string("authors"),
                                 .unit = "",
                                 .summary = "what methods go by that ask how hard an impulse is; "
                                            "the body breaks all the same",
                                 .choices = break_test_names()}};
  return joined(schema, material_options({}, "the target"));
}

std::vector<Scenario> ImportedFamily::scenes(const Options& options, std::string_view,
                                             std::uint64_t) const {
  if (options.text("path").empty()) {
    throw InputError(
        "scenario family 'imported': option 'path' is not given; name the folder of the "
        "collisions");
  }
  const auto limit = static_cast<std::size_t>(options.integer("count"));
  std::vector<Scenario> scenes;
  for (const StoredCollision& collision : read_collision_folder(options.text("path"))) {
    if (limit > 0 && scenes.size() == limit) break;
    // What happens after the break is not known: pieces stay where they are.
    scenes.push_back(
        {.name = collision.name,
         .family = "imported",
         .balls = {},
         .impulses = collision.impulses,
         .material = material_from(options),
         .break_test = break_test_from(options.text("break_test"), "option 'break_test'"),
         .frames = 1,
         .refracture = false});
  }
  return scenes;
}

}  // namespace fracbench
