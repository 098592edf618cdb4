#pragma once

#include <string_view>

#include "core/options.h"
#include "scenarios/scenario.h"

namespace fracbench {

/// The options that every family has: the ball's radius and density, the target's material, the
/// break test, time step and frames. The defaults are the paper's.
OptionsSchema common_options();

/// Adds `schema` behind `first`.
OptionsSchema joined(OptionsSchema first, const OptionsSchema& schema);

/// Number of scenes, one speed for all of them, and range of speeds.
OptionSpec count_option(std::int64_t fallback);
OptionSpec speed_option(double fallback);
OptionsSchema speed_options(double low, double high);

/// Where a ball of a sweep comes from, what it aims at, and how far away it starts.
OptionsSchema shot_options();

/// A scene with everything that common_options() decide, and no ball.
Scenario common_scenario(const Options& options, std::string_view family, std::string name);

/// A ball of the options' radius and density and the target's other properties.
Ball common_ball(const Options& options, const Vec3& position, const Vec3& velocity);

/// Throws InputError where speed_min is above speed_max.
void require_speed_range(const Options& options, std::string_view family);

/// The vector of an option of three numbers. Throws InputError where there are not three.
Vec3 vector_option(const Options& options, std::string_view name, std::string_view family);

/// The same as a unit vector. Throws InputError for the zero vector.
Vec3 direction_option(const Options& options, std::string_view name, std::string_view family);

/// "0007": names of scenes sort as they are numbered.
std::string scene_name(std::int64_t number);

}  // namespace fracbench
