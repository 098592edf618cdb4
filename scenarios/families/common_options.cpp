#include "scenarios/families/common_options.h"

#include <fmt/format.h>

#include "core/error.h"
#include "scenarios/scenario_options.h"

namespace fracbench {

OptionsSchema common_options() {
  const Ball ball;
  const OptionsSchema schema = {{.name = "ball_radius",
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
                                 .maximum = 1e5}};
  // The ball is of the target's material in everything but its density.
  return joined(joined(schema, material_options({}, "the target")), scene_options());
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

OptionSpec speed_option(double fallback) {
  return {.name = "speed",
          .fallback = fallback,
          .unit = "m/s",
          .summary = "speed of every ball",
          .minimum = 1e-3,
          .maximum = 1e4};
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

OptionsSchema shot_options() {
  return {{.name = "from",
           .fallback = std::vector<double>{1, 0, 0},
           .unit = "",
           .summary = "direction that the ball comes from"},
          {.name = "aim",
           .fallback = std::vector<double>{0, 0, 0},
           .unit = "m",
           .summary = "point that the ball flies at",
           .minimum = -1e3,
           .maximum = 1e3},
          {.name = "start_distance",
           .fallback = 3.0,
           .unit = "m",
           .summary = "distance of the ball from its aim at the start",
           .minimum = 0.1,
           .maximum = 1e3}};
}

Scenario common_scenario(const Options& options, std::string_view family, std::string name) {
  Scenario scenario;
  scenario.name = std::move(name);
  scenario.family = family;
  scenario.material = material_from(options);
  read_scene_options(options, scenario);
  return scenario;
}

Ball common_ball(const Options& options, const Vec3& position, const Vec3& velocity) {
  Ball ball = {.position = position,
               .velocity = velocity,
               .radius = options.number("ball_radius"),
               .material = material_from(options)};
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
