#pragma once

#include <string_view>

#include "harness/catalog.h"
#include "harness/suite.h"

namespace fracbench {

/// Changes one value of a suite, as --set does. `assignment` is "key=value" with one of the keys
///   seed, repeats, threads_per_cell, warm_up, device
///   timeout_s, prepare_timeout_s, memory_mb, for all methods or as method.LABEL.timeout_s
///   method.LABEL.OPTION, scenario.LABEL.OPTION, shape.LABEL.OPTION
///   learning.KEY, learning.options.OPTION (of its method), learning.scenario.OPTION
/// where LABEL may be * for all of them. Throws InputError, naming the nearest valid key.
Suite with_override(Suite suite, std::string_view assignment, const Catalog& catalog);

/// The suite at one of its scales: with the shapes and settings of that, called "<suite>-<scale>".
/// Throws InputError, naming the nearest scale.
Suite at_scale(Suite suite, std::string_view scale, const Catalog& catalog);

}  // namespace fracbench
