#include "scenarios/families.h"

#include <fmt/format.h>

#include <string>

#include "core/error.h"
#include "core/text.h"
#include "scenarios/families/dual.h"
#include "scenarios/families/file.h"
#include "scenarios/families/imported.h"
#include "scenarios/families/near_shear.h"
#include "scenarios/families/published.h"
#include "scenarios/families/single.h"
#include "scenarios/families/sweep_direction.h"
#include "scenarios/families/sweep_hit_point.h"
#include "scenarios/families/sweep_strength.h"

namespace fracbench {

namespace {

std::vector<std::unique_ptr<ScenarioFamily>> make_families() {
  std::vector<std::unique_ptr<ScenarioFamily>> families;
  families.push_back(std::make_unique<SingleFamily>());
  families.push_back(std::make_unique<DualFamily>());
  families.push_back(std::make_unique<NearShearFamily>());
  families.push_back(std::make_unique<SweepStrengthFamily>());
  families.push_back(std::make_unique<SweepDirectionFamily>());
  families.push_back(std::make_unique<SweepHitPointFamily>());
  families.push_back(std::make_unique<PublishedFamily>());
  families.push_back(std::make_unique<FileFamily>());
  families.push_back(std::make_unique<ImportedFamily>());
  return families;
}

}  // namespace

const std::vector<std::unique_ptr<ScenarioFamily>>& scenario_families() {
  static const std::vector<std::unique_ptr<ScenarioFamily>> families = make_families();
  return families;
}

const ScenarioFamily& find_family(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& family : scenario_families()) {
    names.push_back(family->info().name);
    if (names.back() == name) return *family;
  }
  throw InputError(
      fmt::format("there is no scenario family '{}'{}", name, did_you_mean(name, names)));
}

}  // namespace fracbench
