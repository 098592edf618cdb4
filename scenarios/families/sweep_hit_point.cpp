#include "scenarios/families/sweep_hit_point.h"

#include "scenarios/families/common_options.h"

namespace fracbench {

FamilyInfo SweepHitPointFamily::info() const {
  return {.name = "sweep-hit-point",
          .summary = "balls of one speed and direction whose aim shifts"};
}

OptionsSchema SweepHitPointFamily::options() const {
  return joined({count_option(7),
                 speed_option(60),
                 {.name = "shift_direction",
                  .fallback = std::vector<double>{0, 1, 0},
                  .unit = "",
                  .summary = "direction in which the aim shifts"},
                 {.name = "shift",
                  .fallback = -0.6,
                  .unit = "m",
                  .summary = "shift of the first ball",
                  .minimum = -1e3,
                  .maximum = 1e3},
                 {.name = "shift_step",
                  .fallback = 0.2,
                  .unit = "m",
                  .summary = "how much farther each next ball is shifted",
                  .minimum = -1e3,
                  .maximum = 1e3}},
                joined(shot_options(), common_options()));
}

std::vector<Scenario> SweepHitPointFamily::scenes(const Options& options, std::string_view,
                                                  std::uint64_t) const {
  const Vec3 from = direction_option(options, "from", "sweep-hit-point");
  const Vec3 aim = vector_option(options, "aim", "sweep-hit-point");
  const Vec3 along = direction_option(options, "shift_direction", "sweep-hit-point");
  std::vector<Scenario> scenes;
  for (std::int64_t k = 0; k < options.integer("count"); ++k) {
    Scenario scene = common_scenario(options, "sweep-hit-point", scene_name(k));
    const double shift =
        options.number("shift") + static_cast<double>(k) * options.number("shift_step");
    scene.balls = {common_ball(options,
                               aim + shift * along + options.number("start_distance") * from,
                               -options.number("speed") * from)};
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace fracbench
