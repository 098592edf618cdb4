#pragma once

#include "core/options.h"
#include "scenarios/scenario.h"

namespace fracbench {

/// The options of a material, with its values as defaults; "of ..." tells whose they are.
OptionsSchema material_options(const Material& defaults, std::string_view whose);
Material material_from(const Options& options);

/// break_test, time_step, frames and refracture: what a scene has besides bodies.
OptionsSchema scene_options();
/// Reads them into `scenario`.
void read_scene_options(const Options& options, Scenario& scenario);

}  // namespace fracbench
