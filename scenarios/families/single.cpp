#include "scenarios/families/single.h"

#include "core/random.h"
#include "scenarios/families/common_options.h"

namespace fracbench {

FamilyInfo SingleFamily::info() const {
  return {.name = "single",
          .summary = "one ball from a random direction, aimed at the origin, at a random speed"};
}

OptionsSchema SingleFamily::options() const {
  OptionsSchema schema = {count_option(300),
                          {.name = "start_distance",
                           .fallback = 3.0,
                           .unit = "m",
                           .summary = "distance of the ball from the origin at the start",
                           .minimum = 0.1,
                           .maximum = 1e3}};
  return joined(joined(schema, speed_options(25, 100)), common_options());
}

std::vector<Scenario> SingleFamily::scenes(const Options& options, std::string_view,
                                           std::uint64_t seed) const {
  require_speed_range(options, "single");
  std::vector<Scenario> scenes;
  for (std::int64_t k = 0; k < options.integer("count"); ++k) {
    Scenario scene = common_scenario(options, "single", scene_name(k));
    Random random(derive_seed(seed, {"single", scene.name}));
    const Vec3 from = random.unit_vector();
    const double speed = random.uniform(options.number("speed_min"), options.number("speed_max"));
    scene.balls = {common_ball(options, options.number("start_distance") * from, -speed * from)};
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace fracbench
