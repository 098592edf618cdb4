#include "core/material_json.h"

#include <nlohmann/json.hpp>

namespace fracbench {

nlohmann::ordered_json breaking_json(const Material& m) {
  return {{"young_modulus", m.young_modulus},
          {"poisson_ratio", m.poisson_ratio},
          {"density", m.density},
          {"strength", m.strength},
          {"toughness", m.toughness},
          {"compressive_factor", m.compressive_factor}};
}

}  // namespace fracbench
