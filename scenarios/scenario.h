#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/impact.h"
#include "core/material.h"
#include "core/vec3.h"

namespace fracbench {

/// Which rule decides that a body breaks; see break_test.h for their definitions.
enum class BreakTest : std::uint8_t { authors, eq2_face, eq2_patch };

/// A projectile that never breaks.
struct Ball {
  Vec3 position = {3, 0, 0};    ///< of its centre at the start, m
  Vec3 velocity = {-60, 0, 0};  ///< m / s
  double radius = 0.4;          ///< m
  /// The paper's ball: like the target, but heavier.
  Material material = {.density = 8900};
};

/// One rigid-body scene: the target rests at the origin in zero gravity, balls fly at it. Or, where
/// impulses are given, these break it at the start, whatever the break test says.
struct Scenario {
  std::string name;    ///< unique within its family: part of the cell's seed and of the record
  std::string family;  ///< "single", "dual", ...
  std::vector<Ball> balls;
  std::vector<GivenImpulse> impulses = {};
  Material material;  ///< of the target
  BreakTest break_test = BreakTest::authors;
  double time_step = 1.0 / 250;  ///< of the rigid-body scene, s
  int frames = 200;              ///< one frame per time step
  bool refracture = true;        ///< pieces that can break may break again
};

/// Everything that determines the scene, for records and keys.
nlohmann::ordered_json to_json(const Scenario& scenario);

/// The other way round, bit for bit. Throws nlohmann::json::exception or InputError for what
/// to_json does not write.
Scenario scenario_from_json(const nlohmann::ordered_json& json);

}  // namespace fracbench
