#include "scenarios/contact_capture.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace fracbench {

namespace {

struct Region {
  std::size_t strongest = 0;  // index of its strongest contact
  Vec3 impulse = Vec3::Zero();
  Vec3 weighted_point = Vec3::Zero();
  double weight = 0;
};

std::vector<Region> merge(std::span<const BodyContact> contacts, double region_size) {
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](std::size_t i) { return contacts[i].impulse.norm(); });
  std::vector<Region> regions;
  for (const std::size_t i : order) {
    auto region = std::ranges::find_if(regions, [&](const Region& r) {
      return contacts[r.strongest].other == contacts[i].other &&
             (contacts[r.strongest].point - contacts[i].point).norm() <= region_size;
    });
    if (region == regions.end()) region = regions.insert(region, Region{.strongest = i});
    const double strength = contacts[i].impulse.norm();
    region->impulse += contacts[i].impulse;
    region->weighted_point += strength * contacts[i].point;
    region->weight += strength;
  }
  std::ranges::stable_sort(regions, std::greater<>(),
                           [](const Region& r) { return r.impulse.norm(); });
  return regions;
}

}  // namespace

CapturedImpulses capture_impulses(std::span<const BodyContact> contacts,
                                  std::span<const StrikerBody> strikers, const StruckBody& body) {
  CapturedImpulses captured;
  for (const Region& region : merge(contacts, body.region_size)) {
    const double magnitude = region.impulse.norm();
    if (!(magnitude > 0)) continue;
    const SurfacePoint place = body.surface->nearest(region.weighted_point / region.weight);
    const TriangleMesh& mesh = *body.mesh;
    const Vec3 area2 = (mesh.corner(place.face, 1) - mesh.corner(place.face, 0))
                           .cross(mesh.corner(place.face, 2) - mesh.corner(place.face, 0));
    const Vec3 normal =
        area2.norm() > 0 ? Vec3(area2.normalized()) : Vec3(-region.impulse / magnitude);
    captured.impulses.push_back({.point = place.point,
                                 .direction = region.impulse / magnitude,
                                 .magnitude = magnitude,
                                 .face = place.face,
                                 .normal = normal,
                                 .face_area = area2.norm() / 2});

    const StrikerBody& striker = strikers[region.strongest];
    const Vec3 world_point = body.state.pose.to_world(place.point);
    const Vec3 striker_velocity =
        striker.state.velocity +
        striker.state.angular_velocity.cross(world_point -
                                             striker.state.pose.to_world(striker.center_of_mass));
    const Vec3 relative =
        body.state.pose.orientation.conjugate() *
        Vec3(striker_velocity - velocity_at(body.state, *body.frame, world_point));
    captured.strikers.push_back({.mass = striker.mass,
                                 .radius = striker.radius,
                                 .young_modulus = striker.material.young_modulus,
                                 .poisson_ratio = striker.material.poisson_ratio,
                                 .velocity = relative});
    captured.speeds.push_back({.approach_speed = std::max(0.0, -relative.dot(normal)),
                               .effective_mass = 1 / (1 / striker.mass + 1 / body.frame->mass)});
  }
  return captured;
}

}  // namespace fracbench
