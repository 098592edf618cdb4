#include "harness/catalog.h"
#include "methods/registry.h"
#include "metrics/registry.h"

namespace fracbench {

Catalog built_in_catalog() {
  return {.methods = methods(),
          .families = scenario_families(),
          .metrics = metrics(),
          .load_shape = load_shape,
          .run_scene = run_scene};
}

}  // namespace fracbench
