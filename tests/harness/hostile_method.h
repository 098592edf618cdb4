#pragma once

#include <memory>

#include "harness/catalog.h"
#include "harness/suite.h"

namespace fracbench {

/// Method "hostile": cuts a box in two halves like a good method, but for what its option `attack`
/// does first, in a share `share` of the impacts, or with `early` while it is prepared. Children
/// that it leaves write their numbers into the file `children`.
std::unique_ptr<Method> make_hostile_method();

/// Box, six impacts, the method "halves" and the hostile one, with limits of 1 s (60 s for halves)
/// and 400 MiB.
Suite hostile_suite(const Catalog& catalog);

}  // namespace fracbench
