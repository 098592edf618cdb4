#include "scenarios/families/sweep_strength.h"

#include "scenarios/families/common_options.h"

namespace fracbench {

FamilyInfo SweepStrengthFamily::info() const {
  return {.name = "sweep-strength", .summary = "balls of rising speed in one direction"};
}

OptionsSchema SweepStrengthFamily::options() const {
  return joined({count_option(7),
                 {.name = "speed",
                  .fallback = 40.0,
                  .unit = "m/s",
                  .summary = "speed of the first ball",
                  .minimum = 1e-3,
                  .maximum = 1e4},
                 {.name = "speed_step",
                  .fallback = 10.0,
                  .unit = "m/s",
                  .summary = "how much faster each next ball is",
                  .minimum = 0,
                  .maximum = 1e4}},
                joined(shot_options(), common_options()));
}

std::vector<Scenario> SweepStrengthFamily::scenes(const Options& options, std::string_view,
                                                  std::uint64_t) const {
  const Vec3 from = direction_option(options, "from", "sweep-strength");
  const Vec3 aim = vector_option(options, "aim", "sweep-strength");
  std::vector<Scenario> scenes;
  for (std::int64_t k = 0; k < options.integer("count"); ++k) {
    Scenario scene = common_scenario(options, "sweep-strength", scene_name(k));
    const double speed =
        options.number("speed") + static_cast<double>(k) * options.number("speed_step");
    scene.balls = {
        common_ball(options, aim + options.number("start_distance") * from, -speed * from)};
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace fracbench
