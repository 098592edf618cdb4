#pragma once

#include <filesystem>

#include "scenarios/scenario.h"

namespace fracbench {

/// Reads a scene written in TOML:
///
///     break_test = "authors"        # these four and the material may be left out
///     time_step = 0.004             # s
///     frames = 200
///     refracture = true
///     [material]                    # of the target
///     strength = 7.6e5              # and the other members of Material
///     [[ball]]                      # one for each ball
///     position = [3, 0, 0]          # m
///     velocity = [-60, 0, 0]        # m / s
///     radius = 0.4                  # m; may be left out, as may those of its material
///     density = 8900
///
/// The scene is named after the file. Throws InputError, with file and line, for what is not TOML,
/// for unknown keys (with the nearest known one) and for values out of range (with their unit).
Scenario read_scenario(const std::filesystem::path& file);

}  // namespace fracbench
