#include "scenarios/scenario_options.h"

#include <fmt/format.h>

#include "scenarios/break_test.h"

namespace fracbench {

OptionsSchema material_options(const Material& defaults, std::string_view whose) {
  const auto option = [&](std::string name, double fallback, std::string unit,
                          std::string_view what, double minimum, double maximum) {
    return OptionSpec{.name = std::move(name),
                      .fallback = fallback,
                      .unit = std::move(unit),
                      .summary = fmt::format("{} of {}", what, whose),
                      .minimum = minimum,
                      .maximum = maximum};
  };
  return {
      option("young_modulus", defaults.young_modulus, "Pa", "Young's modulus", 1, 1e13),
      option("poisson_ratio", defaults.poisson_ratio, "", "Poisson's ratio", 0, 0.499),
      option("density", defaults.density, "kg/m^3", "density", 1, 1e5),
      option("strength", defaults.strength, "Pa", "critical stress", 0, 1e13),
      option("toughness", defaults.toughness, "Pa sqrt(m)", "fracture toughness", 0, 1e12),
      option("compressive_factor", defaults.compressive_factor, "",
             "compressive over tensile strength", 1, 1e3),
      option("friction", defaults.friction, "", "Coulomb's coefficient", 0, 10),
      option("restitution", defaults.restitution, "", "Newton's coefficient", 0, 1),
  };
}

Material material_from(const Options& options) {
  return {.young_modulus = options.number("young_modulus"),
          .poisson_ratio = options.number("poisson_ratio"),
          .density = options.number("density"),
          .strength = options.number("strength"),
          .toughness = options.number("toughness"),
          .compressive_factor = options.number("compressive_factor"),
          .friction = options.number("friction"),
          .restitution = options.number("restitution")};
}

OptionsSchema scene_options() {
  const Scenario scenario;
  return {
      {.name = "break_test",
       .fallback = std::string(name_of(scenario.break_test)),
       .unit = "",
       .summary = "which rule decides that a body breaks",
       .choices = break_test_names()},
      {.name = "time_step",
       .fallback = scenario.time_step,
       .unit = "s",
       .summary = "time between two frames",
       .minimum = 1e-5,
       .maximum = 0.1},
      {.name = "frames",
       .fallback = std::int64_t{scenario.frames},
       .unit = "",
       .summary = "number of time steps",
       .minimum = 1,
       .maximum = 100000},
      {.name = "refracture",
       .fallback = scenario.refracture,
       .unit = "",
       .summary = "pieces that can break may break again"},
  };
}

void read_scene_options(const Options& options, Scenario& scenario) {
  scenario.break_test = break_test_from(options.text("break_test"), "option 'break_test'");
  scenario.time_step = options.number("time_step");
  scenario.frames = static_cast<int>(options.integer("frames"));
  scenario.refracture = options.flag("refracture");
}

}  // namespace fracbench
