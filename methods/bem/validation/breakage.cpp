#include "methods/bem/validation/breakage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/measures.h"
#include "geometry/signed_distance_grid.h"
#include "methods/bem/bem.h"
#include "methods/bem/validation/crack_meshes.h"

namespace fracbench::bem {

namespace {

constexpr double kBallRadius = 0.4;
constexpr double kBallDensity = 8900;
constexpr double kTimeStep = 1.0 / 250;
const Vec3 kHalfSides(0.95, 0.6, 0.45);

}  // namespace

TriangleMesh test_box() {
  const auto coordinates = [](double half) { return std::array{-half, -half / 3, half / 3, half}; };
  return grid_box(coordinates(kHalfSides.x()), coordinates(kHalfSides.y()),
                  coordinates(kHalfSides.z()));
}

std::vector<Hit> test_hits() {
  const auto& h = kHalfSides;
  return {{{h.x(), 0.13, -0.07}, -Vec3::UnitX()}, {{-h.x(), -0.21, 0.11}, Vec3::UnitX()},
          {{0.31, h.y(), 0.09}, -Vec3::UnitY()},  {{-0.43, -h.y(), -0.12}, Vec3::UnitY()},
          {{0.17, 0.23, h.z()}, -Vec3::UnitZ()},  {{-0.37, 0.11, -h.z()}, Vec3::UnitZ()}};
}

Impact ball_impact(const TriangleMesh& body, const Material& material, const Hit& hit,
                   double speed) {
  const double ball_mass =
      kBallDensity * 4 / 3 * std::numbers::pi * kBallRadius * kBallRadius * kBallRadius;
  const double effective_mass = 1 / (1 / ball_mass + 1 / (material.density * volume(body)));
  Impulse impulse;
  impulse.point = hit.point;
  impulse.direction = hit.direction;
  impulse.magnitude = effective_mass * (1 + material.restitution) * speed;
  impulse.normal = -hit.direction;
  double nearest = HUGE_VAL;
  for (std::size_t face = 0; face < body.faces.size(); ++face) {
    const Vec3 area2 = area_vector2(body, face);
    const Vec3 center = (body.corner(face, 0) + body.corner(face, 1) + body.corner(face, 2)) / 3;
    const double distance = (center - hit.point).norm();
    if (area2.normalized().dot(hit.direction) > -0.99 || distance >= nearest) continue;
    nearest = distance;
    impulse.face = static_cast<std::int32_t>(face);
    impulse.face_area = area2.norm() / 2;
  }
  Impact impact;
  impact.impulses = {impulse};
  impact.strikers = {{.mass = ball_mass,
                      .radius = kBallRadius,
                      .young_modulus = Material{}.young_modulus,
                      .poisson_ratio = Material{}.poisson_ratio,
                      .velocity = speed * hit.direction}};
  impact.time_step = kTimeStep;
  return impact;
}

std::vector<Piece> Breakage::pieces(const Hit& hit, double speed, Context& context) const {
  const BemMethod method;
  OptionMap values = {{"triangles", std::int64_t{400}}, {"voxel", 0.04}};
  for (const auto& [name, value] : options) values[name] = value;
  const Options checked(method.options(), values, "validation");
  Random random(seed);
  Context own{.random = random,
              .timer = context.timer,
              .progress = context.progress,
              .stop = context.stop,
              .threads = context.threads,
              .device = context.device};
  const Target target{.name = "box", .mesh = body, .material = material};
  return method.prepare(target, {}, checked, own)
      ->fracture(ball_impact(body, material, hit, speed), own);
}

std::vector<double> relative_volumes(std::span<const Piece> pieces) {
  std::vector<double> volumes;
  double sum = 0;
  for (const Piece& piece : pieces) {
    volumes.push_back(volume(piece.mesh));
    sum += volumes.back();
  }
  for (double& v : volumes) v /= sum;
  std::sort(volumes.rbegin(), volumes.rend());
  return volumes;
}

std::vector<std::int32_t> piece_labels(std::span<const Piece> pieces, const Mat3& turn,
                                       int threads) {
  constexpr int kResolution = 48;
  std::vector<std::int32_t> labels(
      static_cast<std::size_t>(kResolution) * kResolution * kResolution, -1);
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    TriangleMesh mesh = pieces[n].mesh;
    for (Vec3& v : mesh.vertices) v = turn.transpose() * v;
    if (turn.determinant() < 0) {
      for (Face& face : mesh.faces) std::swap(face[1], face[2]);
    }
    const VoxelGrid<float> distance =
        signed_distance_grid(mesh, unit_grid<float>(kResolution), threads);
    for (std::size_t v = 0; v < labels.size(); ++v) {
      if (distance.values[v] > 0) labels[v] = static_cast<std::int32_t>(n);
    }
  }
  return labels;
}

}  // namespace fracbench::bem
