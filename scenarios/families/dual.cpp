#include "scenarios/families/dual.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"
#include "scenarios/families/common_options.h"

namespace fracbench {

namespace {

constexpr int kAttempts = 1000;

/// Uniform in the ball of this radius.
Vec3 point_in_ball(Random& random, double radius) {
  while (true) {
    const Vec3 point(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (point.squaredNorm() <= 1) return radius * point;
  }
}

Ball random_ball(const Options& options, Random& random) {
  const double distance = random.uniform(options.number("start_min"), options.number("start_max"));
  const Vec3 position = distance * random.unit_vector();
  const Vec3 aim = point_in_ball(random, options.number("aim_radius"));
  const double speed = random.uniform(options.number("speed_min"), options.number("speed_max"));
  return common_ball(options, position, speed * (aim - position).normalized());
}

}  // namespace

FamilyInfo DualFamily::info() const {
  return {
      .name = "dual",
      .summary = "two balls at random places, flying at random speeds at points near the origin"};
}

OptionsSchema DualFamily::options() const {
  const OptionsSchema schema = {
      count_option(500),
      {.name = "start_min",
       .fallback = 2.5,
       .unit = "m",
       .summary = "least distance of a ball from the origin at the start",
       .minimum = 0.1,
       .maximum = 1e3},
      {.name = "start_max",
       .fallback = 4.0,
       .unit = "m",
       .summary = "largest distance of a ball from the origin at the start",
       .minimum = 0.1,
       .maximum = 1e3},
      {.name = "aim_radius",
       .fallback = 0.5,
       .unit = "m",
       .summary = "balls aim at points within this distance of the origin",
       .minimum = 0,
       .maximum = 1e3}};
  return joined(joined(schema, speed_options(25, 100)), common_options());
}

std::vector<Scenario> DualFamily::scenes(const Options& options, std::string_view,
                                         std::uint64_t seed) const {
  require_speed_range(options, "dual");
  if (options.number("start_min") > options.number("start_max")) {
    throw InputError(fmt::format("scenario family 'dual': start_min is {} m, above start_max {} m",
                                 options.number("start_min"), options.number("start_max")));
  }
  std::vector<Scenario> scenes;
  for (std::int64_t k = 0; k < options.integer("count"); ++k) {
    Scenario scene = common_scenario(options, "dual", scene_name(k));
    Random random(derive_seed(seed, {"dual", scene.name}));
    scene.balls = {random_ball(options, random)};
    for (int attempt = 0; scene.balls.size() < 2; ++attempt) {
      const Ball ball = random_ball(options, random);
      const double apart = (ball.position - scene.balls[0].position).norm();
      if (apart > 2.01 * ball.radius) scene.balls.push_back(ball);
      if (attempt == kAttempts) {
        throw InputError(fmt::format(
            "scenario family 'dual': two balls of radius {} m find no room at most {} m from the "
            "origin; raise start_max",
            ball.radius, options.number("start_max")));
      }
    }
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace fracbench
