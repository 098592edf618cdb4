#include "scenarios/break_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/text.h"

namespace fracbench {

namespace {

/// Area of the largest contact patch of a ball on a body that is flat there, m^2.
double hertz_patch_area(const Striker& striker, const ContactSpeed& speed,
                        const Material& material) {
  const double compliance =
      (1 - striker.poisson_ratio * striker.poisson_ratio) / striker.young_modulus +
      (1 - material.poisson_ratio * material.poisson_ratio) / material.young_modulus;
  const double energy2 = speed.effective_mass * speed.approach_speed * speed.approach_speed;
  const double depth =
      std::pow(15.0 / 16 * energy2 * compliance / std::sqrt(striker.radius), 2.0 / 5);
  return std::numbers::pi * striker.radius * depth;
}

}  // namespace

BreakTestValues break_test_values(const std::vector<Impulse>& impulses,
                                  const std::vector<Striker>& strikers,
                                  const std::vector<ContactSpeed>& speeds, const Material& material,
                                  double time_step) {
  BreakTestValues values;
  if (impulses.empty()) return values;
  Vec3 net = Vec3::Zero();
  for (const Impulse& impulse : impulses) {
    values.total_impulse += impulse.magnitude;
    net += impulse.magnitude * impulse.direction;
  }
  values.balanced_force = (values.total_impulse + net.norm()) / (2 * time_step);

  const Impulse& strongest = impulses.front();
  const double pressing =
      strongest.magnitude * std::max(0.0, -strongest.direction.dot(strongest.normal)) / time_step;
  const auto stress = [&](double area) {
    // A contact without area has no stress that could be compared: it counts as unbounded.
    return area > 0 ? pressing / area : (pressing > 0 ? std::numeric_limits<double>::max() : 0.0);
  };
  values.eq2_face_stress = stress(strongest.face_area);
  values.eq2_patch_stress = stress(hertz_patch_area(strikers.front(), speeds.front(), material));
  return values;
}

double overload(BreakTest test, const BreakTestValues& values, const Material& material) {
  switch (test) {
    case BreakTest::authors:
      return std::max(values.total_impulse / kBreakingImpulse,
                      values.balanced_force / kBreakingForce);
    case BreakTest::eq2_face:
      return values.eq2_face_stress / material.strength;
    case BreakTest::eq2_patch:
      return std::min(std::pow(values.eq2_patch_stress / material.strength, 5),
                      std::numeric_limits<double>::max());
  }
  return 0;
}

bool breaks(BreakTest test, const BreakTestValues& values, const Material& material) {
  const double excess = overload(test, values, material);
  return test == BreakTest::authors ? excess >= 1 : excess > 1;
}

const std::vector<std::string>& break_test_names() {
  static const std::vector<std::string> names = {"authors", "eq2-face", "eq2-patch"};
  return names;
}

std::string_view name_of(BreakTest test) {
  return break_test_names()[static_cast<std::size_t>(test)];
}

BreakTest break_test_from(std::string_view name, std::string_view where) {
  const auto& names = break_test_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw InputError(
        fmt::format("{}: there is no break test '{}'{}", where, name, did_you_mean(name, names)));
  }
  return static_cast<BreakTest>(found - names.begin());
}

}  // namespace fracbench
