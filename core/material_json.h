#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/material.h"

namespace fracbench {

/// What decides how a material breaks, by the names of the members; friction and restitution, which
/// only collisions need, are not in it.
nlohmann::ordered_json breaking_json(const Material& material);

}  // namespace fracbench
