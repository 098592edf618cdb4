#include "methods/bem/contact_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/bem/elastic_operator.h"

namespace fracbench::bem {

HertzContact hertz_contact(const BoundaryElements& elements, const Material& material,
                           const Impulse& impulse, const Striker& striker) {
  check_elastic_material(material);
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  if (!positive(impulse.magnitude)) {
    throw InputError(fmt::format("an impulse of {} N s cannot load a body: give a positive one",
                                 impulse.magnitude));
  }
  if (!positive(striker.young_modulus) || !positive(striker.radius) || !(striker.mass > 0)) {
    throw InputError(
        fmt::format("the striker needs a positive radius, mass and Young's modulus: they are {} m, "
                    "{} kg and {} Pa",
                    striker.radius, striker.mass, striker.young_modulus));
  }
  const TriangleMesh mesh = {elements.vertices, elements.triangles};
  const MassProperties solid = mass_properties(mesh);
  const double own_mass =
      effective_mass(material.density * solid.volume, material.density * solid.inertia,
                     solid.center, impulse.point, impulse.direction);
  const double reach = kCurvatureReach * bounding_box(mesh).longest_side();
  const double own_curvature = std::max(
      mean_curvature(elements, impulse.point, impulse.normal, reach), -0.9 / striker.radius);

  const auto compliance = [](double modulus, double ratio) {
    return (1 - ratio * ratio) / modulus;
  };
  HertzContact contact;
  contact.mass = 1 / (1 / own_mass + 1 / striker.mass);
  contact.modulus = 1 / (compliance(material.young_modulus, material.poisson_ratio) +
                         compliance(striker.young_modulus, striker.poisson_ratio));
  contact.radius = 1 / (own_curvature + 1 / striker.radius);
  const double approach = striker.velocity.dot(impulse.direction);
  contact.speed = approach > 0 ? approach : impulse.magnitude / contact.mass;
  return contact;
}

std::vector<ContactPatch> contact_patches(const BoundaryElements& elements,
                                          const Material& material, const Impact& impact) {
  if (impact.strikers.size() != impact.impulses.size()) {
    throw InputError(fmt::format("an impact has {} impulses and {} strikers: give one for each",
                                 impact.impulses.size(), impact.strikers.size()));
  }
  std::vector<ContactPatch> patches;
  for (std::size_t k = 0; k < impact.impulses.size(); ++k) {
    const Impulse& impulse = impact.impulses[k];
    const HertzContact contact = hertz_contact(elements, material, impulse, impact.strikers[k]);
    const double duration = contact_duration(contact);
    patches.push_back({.point = impulse.point,
                       .direction = impulse.direction,
                       .normal = impulse.normal,
                       .radius = contact_radius(contact),
                       .force = impulse.magnitude / duration,
                       .duration = duration});
  }
  return patches;
}

Eigen::Matrix3Xd contact_tractions(const BoundaryElements& elements,
                                   std::span<const ContactPatch> patches) {
  Eigen::Matrix3Xd tractions =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(elements.size()));
  std::vector<double> overlap(elements.size());
  for (const ContactPatch& patch : patches) {
    double total = 0;
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const double distance = (elements.centroids[k] - patch.point).norm();
      const bool faces = elements.normals[k].dot(patch.normal) > 0.5;
      overlap[k] = faces && distance < patch.radius + elements.radii[k]
                       ? area_in_ball(elements.corners(k), patch.point, patch.radius)
                       : 0;
      total += overlap[k];
      // Relative to its size, so that a large triangle under the point is not passed over.
      if (distance / elements.radii[k] < least) {
        least = distance / elements.radii[k];
        nearest = k;
      }
    }
    if (!(total > 0)) {
      overlap[nearest] = total = elements.areas[nearest];
    }
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (overlap[k] == 0) continue;
      tractions.col(static_cast<Eigen::Index>(k)) +=
          patch.force * overlap[k] / (total * elements.areas[k]) * patch.direction;
    }
  }
  return tractions;
}

double load_duration(std::span<const ContactPatch> patches) {
  double longest = 0;
  for (const ContactPatch& patch : patches) longest = std::max(longest, patch.duration);
  return longest;
}

}  // namespace fracbench::bem
