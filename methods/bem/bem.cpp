#include "methods/bem/bem.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "geometry/components.h"
#include "geometry/measures.h"
#include "methods/bem/bem_body.h"
#include "methods/bem/bem_options.h"
#include "methods/bem/body_files.h"
#include "methods/bem/validation/behaviour_cases.h"
#include "methods/bem/validation/crack_cases.h"
#include "methods/bem/validation/elastic_cases.h"

namespace fracbench {

MethodInfo BemMethod::info() const {
  MethodInfo info;
  info.name = "bem";
  info.summary = "cracks run through an elastic body by boundary elements, the reference";
  info.publications = {
      {.key = "hahn2015",
       .authors = "David Hahn and Chris Wojtan",
       .title = "High-resolution brittle fracture simulation with boundary elements",
       .journal = "ACM Transactions on Graphics",
       .volume = "34",
       .number = "4",
       .year = 2015,
       .doi = "10.1145/2766896"},
      {.key = "hahn2016",
       .authors = "David Hahn and Chris Wojtan",
       .title = "Fast approximations for boundary element based brittle fracture simulation",
       .journal = "ACM Transactions on Graphics",
       .volume = "35",
       .number = "4",
       .year = 2016,
       .doi = "10.1145/2897824.2925902"}};
  info.shape_type = "crack propagation";
  info.refracture = true;
  info.quick_to_prepare = true;
  return info;
}

OptionsSchema BemMethod::options() const { return bem::options_schema(); }

std::unique_ptr<Breakable> BemMethod::prepare(const Target& target, const LearningData&,
                                              const Options& options, Context& context) const {
  const bem::Settings settings = bem::settings_from(options);
  bem::check_material(target.material);
  if (const auto parts = solid_components(target.mesh).size(); parts != 1) {
    throw InputError(fmt::format(
        "bem: '{}' consists of {} separate bodies; boundary elements need one: join them, or break "
        "them one by one",
        target.name, parts));
  }
  auto body = std::make_unique<bem::BemBody>(bem::BodyState{.settings = settings,
                                                            .body = target,
                                                            .target_volume = volume(target.mesh),
                                                            .target_area = area(target.mesh)});
  body->prepare(context);
  return body;
}

std::unique_ptr<Breakable> BemMethod::load(const std::filesystem::path& folder,
                                           const Target& target, const Options& options) const {
  return std::make_unique<bem::BemBody>(
      bem::read_body(folder, target, bem::settings_from(options)));
}

std::vector<ValidationCase> BemMethod::validation() const {
  std::vector<ValidationCase> cases = bem::elastic_validation_cases();
  for (ValidationCase& one : bem::crack_validation_cases()) cases.push_back(std::move(one));
  for (ValidationCase& one : bem::behaviour_cases()) cases.push_back(std::move(one));
  std::ranges::stable_sort(cases, {}, &ValidationCase::seconds);
  return cases;
}

}  // namespace fracbench
