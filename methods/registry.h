#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "methods/method.h"

namespace fracbench {

/// All methods that are built in, in the order of the documentation.
const std::vector<std::unique_ptr<Method>>& methods();

/// The method of this name. Throws InputError, naming the nearest one.
const Method& find_method(std::string_view name);

}  // namespace fracbench
