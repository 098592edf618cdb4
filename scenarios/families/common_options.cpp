#include "scenarios/families/common_options.h"

#include <fmt/format.h>

#include "core/error.h"
#include "scenarios/break_test.h"

namespace fracbench {

OptionsSchema common_options() {
  const Material material;
  const Scenario scenario;
  const Ball ball;
  return {
      {.name = "ball_radius",
       .fallback = ball.radius,
       .unit = "m",
       .summary = "radius of a ball",
       .minimum = 1e-3,
       .maximum = 10},
      {.name = "ball_density",
       .fallback = ball.material.density,
       .unit = "kg/m^3",
       .summary = "density of a ball",
       .minimum = 1,
       .maximum = 1e5},
      {.name = "young_modulus",
       .fallback = material.young_modulus,
       .unit = "Pa",
       .summary = "Young's modulus of target and ball",
       .minimum = 1,
       .maximum = 1e13},
      {.name = "poisson_ratio",
       .fallback = material.poisson_ratio,
       .unit = "",
       .summary = "Poisson's ratio of target and ball",
       .minimum = 0,
       .maximum = 0.499},
      {.name = "density",
       .fallback = material.density,
       .unit = "kg/m^3",
       .summary = "density of the target",
       .minimum = 1,
       .maximum = 1e5},
      {.name = "strength",
       .fallback = material.strength,
       .unit = "Pa",
       .summary = "critical stress of the target",
       .minimum = 0,
       .maximum = 1e13},
      {.name = "toughness",
       .fallback = material.toughness,
       .unit = "Pa sqrt(m)",
       .summary = "fracture toughness of the target",
       .minimum = 0,
       .maximum = 1e12},
      {.name = "compressive_factor",
       .fallback = material.compressive_factor,
       .unit = "",
       .summary = "compressive over tensile strength of the target",
       .minimum = 1,
       .maximum = 1e3},
      {.name = "friction",
       .fallback = material.friction,
       .unit = "",
       .summary = "Coulomb's coefficient of target and ball",
       .minimum = 0,
       .maximum = 10},
      {.name = "restitution",
       .fallback = material.restitution,
       .unit = "",
       .summary = "Newton's coefficient of target and ball",
       .minimum = 0,
       .maximum = 1},
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

OptionsSchema joined(OptionsSchema first, const OptionsSchema& schema) {
  first.insert(first.end(), schema.begin(), schema.end());
  return first;
}

OptionSpec count_option(std::int64_t fallback) {
  return {.name = "count",
          .fallback = fallback,
          .unit = "",
          .summary = "number of scenes",
          .minimum = 1,
          .maximum = 1e6};
}

OptionsSchema speed_options(double low, double high) {
  return {{.name = "speed_min",
           .fallback = low,
           .unit = "m/s",
           .summary = "lowest speed of a ball",
           .minimum = 1e-3,
           .maximum = 1e4},
          {.name = "speed_max",
           .fallback = high,
           .unit = "m/s",
           .summary = "highest speed of a ball",
           .minimum = 1e-3,
           .maximum = 1e4}};
}

Scenario common_scenario(const Options& options, std::string_view family, std::string name) {
  Scenario scenario;
  scenario.name = std::move(name);
  scenario.family = family;
  scenario.material = {.young_modulus = options.number("young_modulus"),
                       .poisson_ratio = options.number("poisson_ratio"),
                       .density = options.number("density"),
                       .strength = options.number("strength"),
                       .toughness = options.number("toughness"),
                       .compressive_factor = options.number("compressive_factor"),
                       .friction = options.number("friction"),
                       .restitution = options.number("restitution")};
  scenario.break_test = break_test_from(options.text("break_test"), family);
  scenario.time_step = options.number("time_step");
  scenario.frames = static_cast<int>(options.integer("frames"));
  scenario.refracture = options.flag("refracture");
  return scenario;
}

Ball common_ball(const Options& options, const Vec3& position, const Vec3& velocity) {
  Ball ball = {.position = position,
               .velocity = velocity,
               .radius = options.number("ball_radius"),
               .material = common_scenario(options, "", "").material};
  ball.material.density = options.number("ball_density");
  return ball;
}

void require_speed_range(const Options& options, std::string_view family) {
  if (options.number("speed_min") <= options.number("speed_max")) return;
  throw InputError(fmt::format("scenario family '{}': speed_min is {} m/s, above speed_max {} m/s",
                               family, options.number("speed_min"), options.number("speed_max")));
}

Vec3 vector_option(const Options& options, std::string_view name, std::string_view family) {
  const std::vector<double>& numbers = options.numbers(name);
  if (numbers.size() != 3) {
    throw InputError(
        fmt::format("scenario family '{}': option '{}' has {} numbers, needs 3: x, y, z", family,
                    name, numbers.size()));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Vec3 direction_option(const Options& options, std::string_view name, std::string_view family) {
  const Vec3 vector = vector_option(options, name, family);
  if (!(vector.norm() > 0)) {
    throw InputError(fmt::format(
        "scenario family '{}': option '{}' is 0, 0, 0, which is no direction", family, name));
  }
  return vector.normalized();
}

std::string scene_name(std::int64_t number) { return fmt::format("{:04}", number); }

}  // namespace fracbench
