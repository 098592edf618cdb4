#include "scenarios/families/sweep_direction.h"

#include <numbers>

#include "scenarios/families/common_options.h"

namespace fracbench {

FamilyInfo SweepDirectionFamily::info() const {
  return {.name = "sweep-direction",
          .summary = "balls of one speed at one point, from directions that turn about an axis"};
}

OptionsSchema SweepDirectionFamily::options() const {
  return joined({count_option(8),
                 speed_option(60),
                 {.name = "turn_axis",
                  .fallback = std::vector<double>{0, 1, 0},
                  .unit = "",
                  .summary = "axis through the aim that the direction turns about"},
                 {.name = "turn_step",
                  .fallback = 45.0,
                  .unit = "degrees",
                  .summary = "how much farther each next direction is turned",
                  .minimum = -360,
                  .maximum = 360}},
                joined(shot_options(), common_options()));
}

std::vector<Scenario> SweepDirectionFamily::scenes(const Options& options, std::string_view,
                                                   std::uint64_t) const {
  const Vec3 first = direction_option(options, "from", "sweep-direction");
  const Vec3 aim = vector_option(options, "aim", "sweep-direction");
  const Vec3 axis = direction_option(options, "turn_axis", "sweep-direction");
  std::vector<Scenario> scenes;
  for (std::int64_t k = 0; k < options.integer("count"); ++k) {
    Scenario scene = common_scenario(options, "sweep-direction", scene_name(k));
    const double angle =
        static_cast<double>(k) * options.number("turn_step") * std::numbers::pi / 180;
    const Vec3 from = Eigen::AngleAxisd(angle, axis) * first;
    scene.balls = {common_ball(options, aim + options.number("start_distance") * from,
                               -options.number("speed") * from)};
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace fracbench
